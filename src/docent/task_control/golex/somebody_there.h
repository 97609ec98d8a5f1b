#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::task_control {

/// A person who is followed.
struct PersonSeen {
  std::uint32_t id = 0;
  Point2 in_map;       ///< [m]
  double speed = 0.0;  ///< [m/s]
};

/// Whether somebody is at a place. What stands there may be a stool: only who was seen to walk is somebody.
/// Deterministic.
class SomebodyThere {
 public:
  static constexpr double kWalks = 0.3;  ///< [m/s]: what does not move is not followed at such a speed
  static constexpr double kNear = 0.8;   ///< [m] from the middle of the robot's place

  /// All who are followed now.
  void see(std::span<const PersonSeen> people, Time now) {
    std::map<std::uint32_t, Point2> walkers;
    for (const PersonSeen& person : people)
      if (walkers_.contains(person.id) || person.speed >= kWalks) walkers[person.id] = person.in_map;
    walkers_ = std::move(walkers);
    seen_ = now;
  }
  [[nodiscard]] bool is_near(Point2 in_map, Time now) const {
    if (now - seen_ > kFresh) return false;
    return std::any_of(walkers_.begin(), walkers_.end(),
                       [&](const auto& walker) { return distance(walker.second, in_map) <= kNear; });
  }

 private:
  static constexpr Duration kFresh = std::chrono::seconds{1};
  std::map<std::uint32_t, Point2> walkers_;  ///< by id: who is followed and was seen to walk
  Time seen_{};
};

}  // namespace docent::task_control
