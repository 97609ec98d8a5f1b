#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct MovingObjectsParams {
  PieceParams piece{};
  double most_width = 0.9;      ///< [m] of a thing that may be a person, or two close together
  double foreground = 0.25;     ///< [m] so much farther lies the background of what stands free
  double gate = 0.45;           ///< [m] between prediction and sighting: a stride between two sweeps
  double forget = 0.7;          ///< [s] unseen
  double least_speed = 0.2;     ///< [m/s] below: stands
  double most_speed = 2.2;      ///< [m/s] of somebody in a hurry; more is a mix-up
  double least_way = 0.08;      ///< [m] from its first place: less may be noise
  int sightings = 3;            ///< until its velocity counts
  double same_moment = 0.01;    ///< [s] two sightings so close are halves of one thing in two lasers' sweeps
  double place_gain = 0.5;      ///< steady gain of the place, by the surprise
  double velocity_gain = 0.25;  ///< likewise of the velocity
};

/// Finds slim things that stand free (legs, bodies) in laser sweeps and follows them in the odometry's frame, so that
/// their motion over the next second can be foreseen. Needs no map and no localization.
class MovingObjects {
 public:
  explicit MovingObjects(const MovingObjectsParams& params = {}) : params_{params} {}

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
  [[nodiscard]] std::vector<Cluster> find(std::span<const Point2> points, std::span<const double> ranges,
                                          std::span<const int> beams, double bearing_step) const;
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
  MovingObjectsParams params_;
  std::vector<Followed> followed_;
};

}  // namespace docent::collision_avoidance
