#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vector>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {

struct SeenPlacesParams {
  double seen_for = 3.0;       ///< [s] a place counts as free that is out of view
  double between_looks = 0.2;  ///< [s] at least, of those that are kept
  double edge = 1.5;           ///< beams beyond the first and the last that the field still counts
  double widest_post =
      0.105;             ///< [rad] of the robot itself in the field, that hides no leg: ObstacleMemoryParams::blind_gap
  double beyond = 0.05;  ///< [m] that a look must pass a place
  double lattice = 0.05;      ///< [m] between places beside the body
  double past_margin = 0.08;  ///< [m] to which there are places beyond the margin
  double uncovered = 0.02;    ///< [m] more at the sides of a disc, where a turn uncovers places between two sweeps
  int places = 48;            ///< of a closed line round the body
  /// [m] outside the body, of the closed lines of places: so close that it passes between none of them.
  std::array<double, 5> lines{0.25, 0.6, 1.0, 1.6, 2.4};
};

/// What lasers that do not look all round, or have posts of the robot in their field, have seen to be free: all that
/// lies in a field of view now (what hides a place there is met before it), and elsewhere what the last look at it
/// passed through, if that was not long ago. Everything else is unknown. Kept in the odometry's frame. Lasers that
/// together look all round leave nothing unknown.
class SeenPlaces {
 public:
  explicit SeenPlaces(const SeenPlacesParams& params = {}) : params_{params} {}

  /// @param odom_from_base  pose at the sweep's stamp
  void add(std::size_t sensor, SensorSweep sweep, const Pose2& odom_from_base);

  /// Unknown places round the body, base frame, so close together that the body cannot pass between them: on a lattice
  /// within and just beyond `margin` [m] outside of it, and on closed lines farther out. Beside a disc only
  /// those beyond the margin. O(places * looks), none of it where all is in view.
  /// @param odom_from_base  where the base is at `now`
  [[nodiscard]] std::vector<Point2> unknown(const Pose2& odom_from_base, const BaseLimits& limits, double margin,
                                            Time now) const;

 private:
  struct Look {
    SensorSweep sweep;
    PointTransform sensor_from_odom;
  };
  enum class View { out_of_field, met, passed };
  /// Posts that hide less than a leg stay in the field.
  void forget_slim_posts(SensorSweep& sweep) const;
  [[nodiscard]] bool is_in_field(const SensorSweep& sweep, double beam) const;
  /// The beam that looks along a bearing [rad], sensor frame; negative or beyond the last: out of the field.
  [[nodiscard]] double beam_along(const SensorSweep& sweep, double bearing) const;
  [[nodiscard]] View view_of(const Look& look, Point2 in_odom) const;
  void add_beside(std::vector<Point2>& places, const Pose2& odom_from_base, const BaseLimits& limits, double margin,
                  Time now) const;
  [[nodiscard]] bool is_known(Point2 in_odom, Time now) const;
  [[nodiscard]] bool look_all_round() const;

  SeenPlacesParams params_;
  std::vector<std::deque<Look>> looks_;  ///< [sensors] the newest last
  bool all_round_ = false;
};

}  // namespace docent::collision_avoidance
