#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/vision/ceiling/ceiling_mosaic.h"
#include "docent/vision/ceiling/ceiling_samples.h"

namespace docent::vision {

struct PoseFitParams {
  int most_steps = 6;     ///< on each level, > 0
  int coarse_stride = 3;  ///< one of so many samples is looked at on all levels but the finest, > 0
  double outlier = 0.2;   ///< [0 .. 1 of brightness] residuals from which Huber's loss grows linearly: lamps of other
                          ///< rooms, glare; > 0
  double far_weight =
      0.75;  ///< a look at a slope s counts (1 + s^2)^-far_weight: errors of the mount grow like 1 + s^2; >= 0
  double least_share = 0.3;     ///< of the samples that must lie on the mosaic, 0 .. 1
  double least_contrast = 0.2;  ///< gain / 1 below which a picture is taken to show another ceiling, or darkness; > 0
  double close_enough = 5e-4;   ///< [m, rad] a step that ends the search, > 0
  [[nodiscard]] Result<void> validate() const;
};

/// Where a picture of the ceiling was taken.
struct PoseFit {
  Pose2 map_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y [m], theta [rad], as if all samples erred alone
  double correlation = 0.0;                              ///< between picture and mosaic, -1 .. 1
  double gain = 1.0;                                     ///< picture = gain * mosaic + offset
  double offset = 0.0;
  int samples = 0;  ///< that lie on the mosaic
};

/// How a picture and the mosaic agree at a pose, light aside.
struct Agreement {
  double correlation = 0.0;  ///< -1 .. 1; 0 where either is plain
  int samples = 0;           ///< that lie on the mosaic
  double contrast = 0.0;     ///< standard deviation of the mosaic's brightness under the samples
};
[[nodiscard]] Agreement agreement_at(const Pose2& map_from_robot, const MosaicLevel& level, const CameraMount& mount,
                                     std::span<const CeilingSample> samples, double far_weight = 0.75);

/// The pose at which the samples are likeliest, by Gauss-Newton from a pose near by, over the levels from coarse to
/// fine; gain and offset of the picture are unknowns, too. Residuals are those of brightness, with Huber's loss.
/// Nothing where too few samples lie on the mosaic, where these are plain, or where the search does not settle.
/// Deterministic, O(levels * steps * samples).
[[nodiscard]] std::optional<PoseFit> fit_pose(const Pose2& start, const MosaicPyramid& levels, const CameraMount& mount,
                                              std::span<const CeilingSample> samples, const PoseFitParams& params = {});

}  // namespace docent::vision
