#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct RingWatchParams {
  ComplaintParams complaints{};
  int repeats = 14;            ///< echoes in succession that are the very same though the base has moved
  double moved = 0.03;         ///< [m] the base has moved
  double turned = 0.1;         ///< [rad] likewise
  double patience = 1.5;       ///< [s] for two of many: a ring speaks one after the other
  double memory = 0.05;        ///< a reading's share in the running mean
  double many_missing = 0.25;  ///< share of the readings that are none
  double nearly_all = 0.9;     ///< likewise: the ring tells nothing at all
};

/// Watches a ring of range sensors, sonars or infrared, of which neighbours see nearly the same.
///
/// Silent: the whole ring, or two neighbours; one alone is made up for by those beside it. Frozen: many echoes in
/// succession, over all sensors, are the very same as that sensor gave before although the base has moved meanwhile; a
/// lone one may repeat itself along a wall. Half gone: too many readings are none. Late: by stamp.
/// A ring that froze with nothing in reach looks like one with nothing in reach, and misses nothing until then.
class RingWatch {
 public:
  /// @param one, all  names: "sonar reading", "sonars"
  RingWatch(std::string one, std::string all, const RingWatchParams& params = {})
      : one_{std::move(one)}, all_{std::move(all)}, params_{params} {}

  /// @param range  [m]; NaN: no reading @param is_echo  something answered
  void hear(Time now, Time stamp, std::size_t index, double range, bool is_echo, const Pose2& odom_from_base);

  /// @param required  complain about a ring that never spoke, too
  [[nodiscard]] std::optional<Complaint> complaint(Time now, bool required) const;

 private:
  struct Sensor {
    Freshness freshness;
    double range = -1.0;   ///< [m] of the last echo; negative: none
    Pose2 odom_from_base;  ///< when it first gave that range
  };
  void watch_for_freeze(Sensor& sensor, double range, bool is_echo, const Pose2& odom_from_base);
  [[nodiscard]] std::optional<std::size_t> silent_pair(Time now) const;

  std::string one_, all_;
  RingWatchParams params_;
  std::vector<Sensor> ring_;
  Freshness any_;
  double missing_ = 0.0;  ///< share of readings that are none, lately
  int repeats_ = 0;
};

}  // namespace docent::collision_avoidance
