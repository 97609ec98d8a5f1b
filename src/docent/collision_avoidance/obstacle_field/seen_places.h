#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/geometry/point_transform.h"

namespace docent {

/// What lasers that do not look all round have seen to be free: all that lies in a field of view now (what hides a
/// place there is met before it), and elsewhere what the last look at it passed through, if that was not long ago.
/// Everything else is unknown. Kept in the odometry's frame. Lasers that together look all round leave nothing unknown.
class SeenPlaces {
 public:
  /// @param seen_for  [s] a place counts as free that is out of view
  explicit SeenPlaces(double seen_for) : seen_for_{seen_for} {}

  /// @param odom_from_base  pose at the sweep's stamp
  void add(std::size_t sensor, SensorSweep sweep, const Pose2& odom_from_base);

  /// Unknown places round the body, base frame, so close together that the body cannot pass between them: on a lattice
  /// within and just beyond `margin` [m] outside of it, and on closed lines farther out, to kReach. Beside a disc only
  /// those beyond the margin. O(places * looks), none of it where all is in view.
  /// @param odom_from_base  where the base is at `now`
  [[nodiscard]] std::vector<Point2> unknown(const Pose2& odom_from_base, const BaseLimits& limits, double margin,
                                            Time now) const;

  static constexpr double kReach = 2.4;  ///< [m] outside the body

 private:
  struct Look {
    SensorSweep sweep;
    PointTransform sensor_from_odom;
  };
  enum class View { out_of_field, met, passed };
  [[nodiscard]] static View view_of(const Look& look, Point2 in_odom);
  void add_beside(std::vector<Point2>& places, const Pose2& odom_from_base, const BaseLimits& limits, double margin,
                  Time now) const;
  [[nodiscard]] bool is_known(Point2 in_odom, Time now) const;
  [[nodiscard]] bool look_all_round() const;

  double seen_for_;
  std::vector<std::deque<Look>> looks_;  ///< [sensors] the newest last
  bool all_round_ = false;
};

}  // namespace docent
