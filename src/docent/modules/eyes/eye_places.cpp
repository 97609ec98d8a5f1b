#include "docent/modules/eyes/eye_places.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace docent::modules {

Result<void> EyePlace::validate() const {
  constexpr double kFarthest = 3.0;  // [m] from the base's middle
  if (!(std::abs(x) <= kFarthest && std::abs(y) <= kFarthest)) return fail("place: x and y must be -3..3");
  if (!(z > 0.0 && z <= kFarthest)) return fail("place: z must be above 0 and at most 3");
  if (!(std::abs(pan) <= 360.0 && std::abs(roll) <= 360.0)) return fail("place: pan and roll must be -360..360");
  if (!(std::abs(tilt) <= 90.0)) return fail("place: tilt must be -90..90");
  return {};
}

vision::DepthCameraMount EyePlace::depth_mount() const {
  return {x, y, z, Angle::degrees(pan), Angle::degrees(-tilt), Angle::degrees(roll)};
}

vision::CameraMount EyePlace::camera_mount() const {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double p = pan * kDegree, t = tilt * kDegree, r = roll * kDegree;
  const Eigen::Vector3d ahead{std::cos(t) * std::cos(p), std::cos(t) * std::sin(p), std::sin(t)};
  const Eigen::Vector3d right{std::sin(p), -std::cos(p), 0.0};
  const Eigen::Vector3d down = ahead.cross(right);
  vision::CameraMount mount;
  mount.position = {x, y, z};
  // A camera that is turned clockwise has its right where down was.
  mount.robot_from_camera.col(0) = std::cos(r) * right + std::sin(r) * down;
  mount.robot_from_camera.col(1) = std::cos(r) * down - std::sin(r) * right;
  mount.robot_from_camera.col(2) = ahead;
  return mount;
}

EyePlace place_of(const vision::CameraMount& mount) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const Eigen::Vector3d ahead = mount.robot_from_camera.col(2);
  EyePlace place{mount.position.x(), mount.position.y(), mount.position.z(), 0.0, 0.0, 0.0};
  const double level = std::hypot(ahead.x(), ahead.y());
  place.tilt = std::atan2(ahead.z(), level) / kDegree;
  constexpr double kStraight = 1e-9;
  place.pan = level > kStraight ? std::atan2(ahead.y(), ahead.x()) / kDegree : 0.0;
  const Eigen::Matrix3d level_from_camera =
      place.camera_mount().robot_from_camera.transpose() * mount.robot_from_camera;
  place.roll = std::atan2(level_from_camera(1, 0), level_from_camera(0, 0)) / kDegree;
  return place;
}

Result<void> CeilingParams::validate() const {
  constexpr double kSteepest = 4.0, kLevel = 45.0;  // slope; [deg]
  if (auto valid = place.validate(); !valid) return valid;
  if (!(place.tilt > kLevel)) return fail("place.tilt must be above 45: it looks up");
  if (!(steepest > 0.0 && steepest <= kSteepest)) return fail("steepest must be above 0 and at most 4");
  return {};
}

Result<void> SightParams::validate() const {
  if (auto valid = place.validate(); !valid) return valid;
  if (enabled && !(place.tilt < 0.0)) return fail("place.tilt must be below 0: it looks at the floor");
  if (!(reach > 0.5)) return fail("reach must be > 0.5");
  return sight().validate();
}

Result<void> ThingsParams::validate() const {
  if (auto valid = place.validate(); !valid) return valid;
  if (enabled && !(place.tilt < 0.0)) return fail("place.tilt must be below 0: it looks at the floor");
  if (!(turning > 0.0)) return fail("turning must be > 0");
  if (auto valid = floor.validate(); !valid) return valid;
  return map.validate();
}

vision::DepthSightParams SightParams::sight() const {
  vision::DepthSightParams params;
  params.heights.low = low;
  params.heights.robot_height = robot_height;
  params.heights.drop = drop;
  params.heights.reach = params.lines.reach = reach;
  return params;
}

}  // namespace docent::modules
