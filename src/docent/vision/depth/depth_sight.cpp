#include "docent/vision/depth/depth_sight.h"

namespace docent::vision {
namespace {

constexpr std::uint64_t kSeed = 53;  // of the plane's trials: the same picture, the same floor

}  // namespace

Result<void> DepthSightParams::validate() const {
  if (auto valid = ground.validate(); !valid) return valid;
  if (auto valid = heights.validate(); !valid) return valid;
  if (auto valid = layer.validate(); !valid) return valid;
  return lines.validate();
}

DepthSight::DepthSight(const DepthCamera& camera, const DepthSightParams& params)
    : camera_{camera},
      params_{params},
      finder_{camera, params.heights, params.ground},
      layer_{camera, params.layer, params.heights.low, params.heights.robot_height},
      rng_{kSeed} {}

Result<const Heights*> DepthSight::see(const DepthPicture& picture, const Pose2& odom_from_base) {
  const bool is_whole = picture.columns == camera_.columns && picture.rows == camera_.rows &&
                        picture.depth.size() == static_cast<std::size_t>(picture.columns * picture.rows);
  if (!is_whole) return fail("a depth picture of another size than the camera's");
  const Heights& heights = finder_.find(picture, rng_);
  if (heights.is_blind) return fail("hardly anything comes back to the depth camera");
  layer_.add(picture, heights, odom_from_base);
  return &heights;
}

std::vector<SeenLine> DepthSight::lines(const Pose2& odom_from_base) const {
  return lines_of(layer_.cells(), odom_from_base, params_.layer.cell, camera_.mount.z, params_.lines);
}

}  // namespace docent::vision
