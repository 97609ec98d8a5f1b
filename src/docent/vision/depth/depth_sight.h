#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/vision/depth/depth_layer.h"
#include "docent/vision/depth/seen_lines.h"

namespace docent::vision {

struct DepthSightParams {
  GroundPlaneParams ground;
  HeightParams heights;
  DepthLayerParams layer;
  SeenLinesParams lines;
  [[nodiscard]] Result<void> validate() const;
};

/// From depth pictures to lines that are in the way: plane, heights, layer, lines. Deterministic.
class DepthSight {
 public:
  /// @pre camera and parameters are valid
  explicit DepthSight(const DepthCamera& camera, const DepthSightParams& params = {});

  /// @param odom_from_base  when the picture was taken
  /// @returns what the picture alone says; Error: not of the camera's size, or blind: then nothing is changed
  [[nodiscard]] Result<const Heights*> see(const DepthPicture& picture, const Pose2& odom_from_base);

  /// What is in the way now, base. @param odom_from_base  now
  [[nodiscard]] std::vector<SeenLine> lines(const Pose2& odom_from_base) const;
  /// Odometry's frame.
  [[nodiscard]] std::vector<LayerCell> cells() const { return layer_.cells(); }

 private:
  DepthCamera camera_;
  DepthSightParams params_;
  HeightFinder finder_;
  DepthLayer layer_;
  Rng rng_;
};

}  // namespace docent::vision
