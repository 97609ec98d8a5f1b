#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/mapping/graph_mapping/mapping_scan.h"
#include "docent/mapping/occupancy/growing_map.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::planning {

/// Part `keyframes` of section `explore`: what the map is made of.
struct KeyframeParams {
  double way = 0.2;       ///< [m], > 0: scans are taken for the map after this way,
  double turn = 10.0;     ///< [deg], > 0: this turn,
  double pause = 5.0;     ///< [s], > 0: or this time, for what stands in the way now may be gone
  double together = 0.4;  ///< [s], > 0: sweeps of two lasers no farther apart are of one moment: one may be late
  double person = 0.5;    ///< [m], >= 0: what is seen so near to the place of a tracked person is of them
  template <class V>
  void visit(V& v) {
    v("way", way);
    v("turn", turn);
    v("pause", pause);
    v("together", together);
    v("person", person);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What all lasers saw at a moment that is worth to be kept.
struct Keyframe {
  Time stamp{};
  mapping::MappingScan scan;
  std::vector<mapping::MountedSweep> sweeps;
};

/// Chooses the moments of a drive that a map is made of, and joins the sweeps of all lasers.
class Keyframes {
 public:
  /// @param base_from_laser  [lasers], at least one: where they are mounted
  Keyframes(const KeyframeParams& params, const mapping::PointSweepParams& points, std::vector<Pose2> base_from_laser);

  /// A laser is found to be mounted elsewhere. @returns where it was thought to be
  Pose2 mount(std::size_t laser, const Pose2& base_from_laser) {
    return std::exchange(base_from_laser_[laser], base_from_laser);
  }
  /// The newest sweep of a laser, in place of the one before.
  void keep(std::size_t laser, Time stamp, const sensor_models::LaserReading& reading);
  /// After a sweep of the first laser: all lasers about the robot's centre at that moment.
  struct Look {
    Time stamp{};
    Pose2 odom_from_base;
    sensor_models::RangeSweep sweep;
  };
  [[nodiscard]] std::optional<Look> look(const collision_avoidance::BaseHistory& odometry) const;
  /// The same, kept for the map, if the robot has moved enough since the last one.
  /// @param people  [m], odom: what is seen of them belongs to no map
  [[nodiscard]] std::optional<Keyframe> take(const collision_avoidance::BaseHistory& odometry,
                                             std::span<const Point2> people);

 private:
  struct Newest {
    Time stamp{};
    sensor_models::LaserReading reading;  ///< without its ranges
    std::vector<float> ranges;            ///< [m]
  };
  /// [lasers] where the base was when each newest sweep was taken, odom; none: it is of another moment.
  [[nodiscard]] std::vector<std::optional<Pose2>> bases(const collision_avoidance::BaseHistory& odometry) const;
  [[nodiscard]] sensor_models::LaserReading reading(std::size_t laser) const;

  KeyframeParams params_;
  mapping::PointSweepParams points_;
  std::vector<Pose2> base_from_laser_;  ///< [lasers]
  std::vector<Newest> newest_;          ///< [lasers]
  std::optional<Pose2> last_;           ///< odom_from_base of the last moment
  Time last_stamp_{};
};

}  // namespace docent::planning
