#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent {

/// Finds slim things that stand free (legs, bodies) in laser sweeps and follows them in the odometry's frame, so that
/// their motion over the next second can be foreseen. Needs no map and no localization.
class MovingObjects {
 public:
  struct Cluster {
    std::size_t first = 0;  ///< index of its first point
    std::size_t count = 0;
    Point2 centre;       ///< [m], odom
    double width = 0.0;  ///< [m]
    Point2 velocity{};   ///< [m/s], zero until it is known to move
  };

  /// Groups neighbouring points of one sweep, in the order of their bearings, that belong to slim free-standing things.
  /// @param points  odom frame
  /// @param ranges  [points] distance from the sensor
  /// @param beams   [points] index of the beam; a gap between two beams is open background
  [[nodiscard]] static std::vector<Cluster> find(std::span<const Point2> points, std::span<const double> ranges,
                                                 std::span<const int> beams, double bearing_step);
  /// Matches the clusters with what is followed and fills in their velocities. O(clusters * followed).
  void follow(Time stamp, std::vector<Cluster>& clusters);

 private:
  struct Followed {
    Point2 place;
    Point2 velocity{};
    Time seen;
    Point2 first_place;
    int sightings = 1;
  };
  std::vector<Followed> followed_;
};

}  // namespace docent
