#pragma once

#include <optional>

#include "docent/vision/ceiling/pose_fit.h"

namespace docent::vision {

struct CeilingTrackerParams {
  PoseFitParams fit;
  double window = 0.15;       ///< [m] the search starts from the best of places so far around the predicted one, >= 0
  double window_turn = 0.06;  ///< [rad] likewise, >= 0
  double good_start = 0.6;    ///< correlation at the predicted place from which no other is tried
  int window_steps = 1;       ///< places tried to each side of the predicted one in x, y and theta, >= 0
  int window_samples = 120;   ///< samples that choose among them, > 0
  double least_correlation = 0.5;  ///< of picture and mosaic, below which the picture says nothing
};

/// Follows a robot by the ceiling, picture by picture: odometry, or the last motion where there is none, says where to
/// look, the picture says where it is. A picture that says nothing leaves the prediction.
class CeilingTracker {
 public:
  CeilingTracker(MosaicPyramid levels, const CameraMount& mount, const Pose2& start,
                 const CeilingTrackerParams& params = {});

  /// @param motion  of the robot since the last picture, in its own axes; without: as since the picture before
  /// Nothing when the picture does not say where it was taken.
  std::optional<PoseFit> track(std::span<const CeilingSample> samples, const std::optional<Pose2>& motion = {});
  [[nodiscard]] const Pose2& map_from_robot() const { return map_from_robot_; }

 private:
  /// Of the few samples on the coarsest level.
  [[nodiscard]] double coarse_correlation(const Pose2& map_from_robot) const;
  [[nodiscard]] Pose2 best_start(const Pose2& predicted, std::span<const CeilingSample> samples);

  MosaicPyramid levels_;
  CameraMount mount_;
  CeilingTrackerParams params_;
  Pose2 map_from_robot_;
  Pose2 motion_;
  double last_correlation_ = 1.0;  ///< of the few samples on the coarsest level, where the last picture was found
  std::vector<CeilingSample> few_;
};

}  // namespace docent::vision
