#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {

struct RangeFlowParams {
  double look_back = 0.25;       ///< [s] at least: in less, noise looks like motion
  double forget = 0.55;          ///< [s] older sweeps tell of another motion
  double clear = 0.1;            ///< [m] so much behind a place the beams must have ended
  double least_speed = 0.3;      ///< [m/s] less is noise
  double most_speed = 2.2;       ///< [m/s] of somebody in a hurry
  double window = 0.45;          ///< [rad] to either side, for what was met near a place before
  double side_by_side = 0.2;     ///< [m] between two places of one piece
  double stiff = 0.05;           ///< share of a place, towards no motion across the normals
  std::size_t least_places = 3;  ///< of a piece: a beam that grazes an edge is borne out by none beside it
};

/// How fast what a laser meets comes nearer, place by place, without knowing what belongs together: in a throng people
/// hide and touch each other, and nothing slim stands free that could be followed.
///
/// A place through which the sensor looked a moment ago and where it now meets something has been reached by whatever
/// was nearest to it then: that is the motion along the surface's normal, the range flow of [SpiesJaehneBarron2002].
/// The normals of one piece together say how it moves. What was hidden then may always have been there, and of who goes
/// away nothing is said.
class RangeFlow {
 public:
  explicit RangeFlow(const RangeFlowParams& params = {}) : params_{params} {}

  /// The newest sweep of the sensor, its points in the order of their bearings.
  /// @param ranges  [m] of all beams; NaN: no reading
  /// @param places  [m] odom, of the beams that met something; `beams` says which
  void add(Time stamp, const Pose2& odom_from_sensor, double first_bearing, double bearing_step,
           std::span<const float> ranges, std::span<const Point2> places, std::span<const int> beams);
  /// Velocity [m/s], odom, of each place of the newest sweep, zero where nothing is known to come nearer. Some places
  /// of a piece must have been looked through. O(places), with a window of beams each.
  [[nodiscard]] std::vector<Point2> velocities() const;

 private:
  struct Look {
    Time stamp;
    Pose2 odom_from_sensor;
    double first_bearing = 0.0;
    double bearing_step = 0.0;
    std::vector<float> ranges;
    std::vector<Point2> places;
    std::vector<int> beams;
  };
  /// Motion [m/s] along the surface's normal of what has come to `place`.
  [[nodiscard]] std::optional<Point2> approach(const Look& before, const PointTransform& before_from_odom,
                                               const Look& now, Point2 place) const;

  /// The motion whose components along its normals are these.
  [[nodiscard]] Point2 motion(std::span<const Point2> along_normals) const;

  RangeFlowParams params_;
  std::deque<Look> looks_;
};

}  // namespace docent::collision_avoidance
