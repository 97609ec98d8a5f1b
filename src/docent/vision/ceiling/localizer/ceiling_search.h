#pragma once

#include <span>
#include <utility>
#include <vector>

#include "docent/vision/ceiling/ceiling_mosaic.h"
#include "docent/vision/ceiling/ceiling_samples.h"

namespace docent::vision {

/// Looks for the places of a whole ceiling where a picture may have been taken, at all headings. The looks of a
/// heading are turned once for all its places; a few samples choose the places that all of them are compared at.
class CeilingSearch {
 public:
  /// @param level  outlives this. @param step [m], turn [deg]  from place to place
  CeilingSearch(const CeilingMosaic& mosaic, const MosaicLevel& level, const CameraMount& mount, double step,
                double turn);

  /// @returns poses by falling correlation, at most so many. O(places * samples / 3)
  [[nodiscard]] std::vector<std::pair<double, Pose2>> best(std::span<const CeilingSample> samples,
                                                           std::size_t most) const;

 private:
  struct Looks;
  [[nodiscard]] double correlation_at(Point2 cells, const Looks& looks, std::size_t count) const;

  const MosaicLevel* level_;
  CameraMount mount_;
  int headings_;
  std::vector<Point2> places_;  ///< [m], map
};

}  // namespace docent::vision
