#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/mapping/graph_mapping/mapping_scan.h"
#include "docent/mapping/occupancy/growing_map.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/scanners.h"

namespace docent::modules {

/// Part `keyframes` of section `explore`: what the map is made of.
struct KeyframeParams {
  double way = 0.2;        ///< [m], > 0: scans are taken for the map after this way,
  double turn = 10.0;      ///< [deg], > 0: this turn,
  double pause = 5.0;      ///< [s], > 0: or this time, for what stands in the way now may be gone
  double together = 0.15;  ///< [s], > 0: sweeps of two lasers no farther apart are of one moment
  double person = 0.5;     ///< [m], >= 0: what is seen so near to the place of a tracked person is of them
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
  Keyframes(const KeyframeParams& params, const mapping::PointSweepParams& points,
            const std::vector<robot::Scanner>& scanners);

  void keep(std::size_t laser, const sensor_msgs::LaserScan& scan);
  /// After a sweep of the first laser: all lasers about the robot's centre at that moment.
  struct Look {
    Time stamp{};
    Pose2 odom_from_base;
    sensor_models::RangeSweep sweep;
  };
  [[nodiscard]] std::optional<Look> look(const PoseTracker& pose) const;
  /// The same, kept for the map, if the robot has moved enough since the last one.
  /// @param people  [m], odom: what is seen of them belongs to no map
  [[nodiscard]] std::optional<Keyframe> take(const PoseTracker& pose, std::span<const Point2> people);

 private:
  /// [scanners] where the base was when each newest sweep was taken, odom; none: it is of another moment.
  [[nodiscard]] std::vector<std::optional<Pose2>> bases(const PoseTracker& pose) const;
  [[nodiscard]] sensor_models::LaserReading reading(std::size_t laser) const;

  KeyframeParams params_;
  mapping::PointSweepParams points_;
  std::vector<Pose2> base_from_laser_;          ///< [scanners]
  std::vector<sensor_msgs::LaserScan> newest_;  ///< [scanners]
  std::optional<Pose2> last_;                   ///< odom_from_base of the last moment
  Time last_stamp_{};
};

}  // namespace docent::modules
