#include "docent/simulator/sensing/camera/eyes/eye_rig.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr double kRadiansOfDegree = std::numbers::pi / 180.0;

/// Numbers of a lens for a picture of 320 pixels, for one of any width.
LensModel scaled(LensModel lens, const RigOptions& options) {
  const double by = options.width / 320.0;
  lens.width = options.width, lens.height = options.height;
  lens.focal_x *= by, lens.focal_y *= by;
  lens.centre_x = 0.5 * options.width + by * (lens.centre_x - 160.0);
  lens.centre_y = 0.5 * options.height + by * (lens.centre_y - 120.0);
  return lens;
}

LensModel disturbed(LensModel lens, Rng& rng) {
  constexpr double kFocal = 0.003, kCentre = 0.004;  // deviations: of the focal length, and in widths of the picture
  const double focal = rng.normal(1.0, kFocal);
  lens.focal_x *= focal * rng.normal(1.0, 0.0005);
  lens.focal_y *= focal;
  lens.centre_x += kCentre * lens.width * rng.normal();
  lens.centre_y += kCentre * lens.width * rng.normal();
  if (lens.kind == LensKind::fisheye) {
    for (std::size_t i = 0; i < 2; ++i) lens.fisheye[i] += (i == 0 ? 0.003 : 0.001) * rng.normal();
  } else if (lens.brown[0] != 0.0) {
    lens.brown[0] += 0.006 * rng.normal();
    lens.brown[1] += 0.004 * rng.normal();
    lens.brown[2] += 0.0003 * rng.normal();
    lens.brown[3] += 0.0003 * rng.normal();
  }
  return lens;
}

CameraMount disturbed(CameraMount mount, Rng& rng) {
  constexpr double kPlace = 0.004, kTurn = 0.35 * kRadiansOfDegree;  // deviations: [m], [rad]
  mount.x += kPlace * rng.normal(), mount.y += kPlace * rng.normal(), mount.z += kPlace * rng.normal();
  mount.pan += kTurn * rng.normal(), mount.tilt += kTurn * rng.normal(), mount.roll += kTurn * rng.normal();
  return mount;
}

template <class... Numbers>
std::string filled(const char* form, Numbers... numbers) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), form, numbers...);
  return text.data();
}

std::string text_of(const char* name, const Eye& eye) {
  const LensModel& l = eye.lens;
  const auto& m = eye.mount;
  std::string text = std::string{name} + ":\n";
  text += std::string{"  model: "} + (l.kind == LensKind::fisheye ? "fisheye" : "brown") + "\n";
  text += filled("  width: %d\n  height: %d\n  focal: [%.4f, %.4f]\n  centre: [%.4f, %.4f]\n", l.width, l.height,
                 l.focal_x, l.focal_y, l.centre_x, l.centre_y);
  text += l.kind == LensKind::fisheye ? filled("  distortion: [%.7f, %.7f, %.7f, %.7f]\n", l.fisheye[0], l.fisheye[1],
                                               l.fisheye[2], l.fisheye[3])
                                      : filled("  distortion: [%.7f, %.7f, %.7f, %.7f, %.7f]\n", l.brown[0], l.brown[1],
                                               l.brown[2], l.brown[3], l.brown[4]);
  return text + filled("  mount: {x: %.4f, y: %.4f, z: %.4f, pan: %.4f, tilt: %.4f, roll: %.4f}\n", m.x, m.y, m.z,
                       m.pan / kRadiansOfDegree, m.tilt / kRadiansOfDegree, m.roll / kRadiansOfDegree);
}

}  // namespace

EyeRig told_rig(const RigOptions& options) {
  LensModel up;
  up.focal_x = up.focal_y = 205.0;  // 76 degrees across
  up.centre_x = 161.5, up.centre_y = 118.7;
  up.brown = {-0.19, 0.05, 0.0006, -0.0004, 0.0};
  if (options.fisheye) {
    up.kind = LensKind::fisheye;
    up.focal_x = up.focal_y = 92.0;
    up.fisheye = {-0.025, 0.003, -0.0008, 0.0};
    up.widest = 1.45;
  }
  LensModel front;
  front.focal_x = front.focal_y = 232.0;  // 69 degrees
  front.centre_x = 158.6, front.centre_y = 121.1;
  front.brown = {-0.11, 0.03, -0.0003, 0.0005, 0.0};
  LensModel depth;
  depth.focal_x = depth.focal_y = 290.0;  // 58 degrees; its driver hands out undistorted pictures
  const auto degrees = [](double angle) { return angle * kRadiansOfDegree; };
  const CameraMount up_mount{.x = 0.10, .y = 0.0, .z = 1.25, .pan = 0.0, .tilt = degrees(90.0), .roll = 0.0};
  const CameraMount front_mount{.x = 0.16, .y = 0.05, .z = 1.10, .pan = 0.0, .tilt = degrees(-28.0), .roll = 0.0};
  const CameraMount depth_mount{.x = 0.16, .y = -0.03, .z = 1.05, .pan = 0.0, .tilt = degrees(-30.0), .roll = 0.0};
  return {{scaled(up, options), options.up_mount.value_or(up_mount)},
          {scaled(front, options), options.front_mount.value_or(front_mount)},
          {scaled(depth, options), options.depth_mount.value_or(depth_mount)}};
}

EyeRig true_rig(const EyeRig& told, Rng rng) {
  EyeRig rig;
  rig.up = {disturbed(told.up.lens, rng), disturbed(told.up.mount, rng)};
  rig.front = {disturbed(told.front.lens, rng), disturbed(told.front.mount, rng)};
  rig.depth = {disturbed(told.depth.lens, rng), disturbed(told.depth.mount, rng)};
  return rig;
}

std::string to_yaml(const EyeRig& rig) {
  return "# Pixels from the upper left corner of the picture, degrees, metres in the base's frame (x ahead, y left, z "
         "up).\n"
         "# brown: k1 k2 p1 p2 k3; fisheye: k1..k4 of the angle. tilt 90 looks up, its picture's upper edge to the "
         "rear.\n" +
         text_of("up", rig.up) + text_of("front", rig.front) + text_of("depth", rig.depth);
}

}  // namespace docent::simulator
