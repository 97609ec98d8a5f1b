#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "docent/vision/ceiling/ceiling_mosaic.h"
#include "docent/vision/ceiling/ceiling_samples.h"

namespace docent::vision {

/// Where under a whole ceiling some pictures may have been taken: Markov localization on a grid of places and headings
/// ([Markov1998] 2), coarse, with every picture's likelihood there kept, so that pictures of one way are judged
/// together.
class CeilingSearch {
 public:
  /// @param step [m], turn [deg]  from place to place of the grid
  CeilingSearch(const CeilingMosaic& mosaic, const MosaicLevel& level, const CameraMount& mount, double step,
                double turn);

  /// ln p of a picture at every place and heading, up to a factor. [headings][rows][columns]
  using Likelihoods = std::vector<std::uint8_t>;
  /// O(places * headings * samples)
  [[nodiscard]] Likelihoods likelihoods(std::span<const CeilingSample> samples) const;

  /// A picture that was taken on the way to here.
  struct View {
    const Likelihoods* likelihoods = nullptr;
    Pose2 here_from_view;  ///< by odometry
  };
  /// @returns poses by falling likelihood, at most so many, no two alike. O(places * headings * views)
  [[nodiscard]] std::vector<Pose2> best(std::span<const View> views, std::size_t most) const;

 private:
  using Plane = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  /// What one height of the ceiling looks like; 0 where it is none.
  struct Part {
    double height = 0.0;
    Plane is_there, brightness, square;
    [[nodiscard]] float area() const { return is_there.sum(); }  ///< [cells]
  };
  struct Sums;
  void join_parts();
  [[nodiscard]] bool is_below(int row, int column) const;
  [[nodiscard]] int width() const;  ///< of the planes, with their margins
  [[nodiscard]] int height() const;
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(headings_) * static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_);
  }
  [[nodiscard]] Pose2 pose_of(std::size_t index) const;
  [[nodiscard]] std::vector<std::uint16_t> summed(std::span<const View> views) const;

  CameraMount mount_;
  Point2 origin_;
  double step_;
  int headings_, rows_, columns_;
  std::vector<Part> parts_;
};

}  // namespace docent::vision
