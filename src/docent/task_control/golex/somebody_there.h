#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
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

/// Whether somebody is at a place. What stands there may be a stool: only who was seen to walk lately is somebody, for
/// a track of somebody who passes may stay with the stool; and what was there before anybody came stays a thing.
/// Deterministic.
class SomebodyThere {
 public:
  static constexpr double kWalks = 0.3;  ///< [m/s]: what does not move is not followed at such a speed
  static constexpr double kNear = 0.8;   ///< [m] from the middle of the robot's place
  static constexpr Duration kStands = std::chrono::seconds{20};  ///< without a step: then it may be a stool
  static constexpr Duration kAlone = std::chrono::seconds{3};    ///< that something stands there and nobody is near

  /// All who are followed now.
  void see(std::span<const PersonSeen> people, Time now) {
    std::map<std::uint32_t, Walker> walkers;
    for (const PersonSeen& person : people) {
      const auto known = walkers_.find(person.id);
      if (person.speed >= kWalks) {
        walkers[person.id] = {person.in_map, now};
      } else if (known != walkers_.end() && now - known->second.walked <= kStands) {
        walkers[person.id] = {person.in_map, known->second.walked};
      }
    }
    walkers_ = std::move(walkers);
    seen_ = now;
  }
  [[nodiscard]] bool is_near(Point2 in_map, Time now) const {
    if (now - seen_ > kFresh) return false;
    return std::any_of(walkers_.begin(), walkers_.end(),
                       [&](const auto& walker) { return distance(walker.second.in_map, in_map) <= kNear; });
  }
  /// Something stands at the place, or nothing does.
  /// @returns whether it is a thing: it stands, and nobody is near, or nobody was when it was seen there first
  bool is_thing(Point2 in_map, bool is_occupied, Time now) {
    const bool is_alone = is_occupied && !is_near(in_map, now);
    if (!is_occupied) {
      alone_since_.reset();
      stays_ = false;
    } else if (is_alone && !alone_since_) {
      alone_since_ = now;
    } else if (!is_alone && !stays_) {
      alone_since_.reset();
    }
    stays_ = stays_ || (alone_since_ && now - *alone_since_ >= kAlone);
    return is_alone || stays_;
  }

 private:
  static constexpr Duration kFresh = std::chrono::seconds{1};
  struct Walker {
    Point2 in_map;
    Time walked;
  };
  std::map<std::uint32_t, Walker> walkers_;  ///< by id: who is followed and was seen to walk
  std::optional<Time> alone_since_;          ///< something stands there and nobody is near
  bool stays_ = false;                       ///< and did so for long
  Time seen_{};
};

}  // namespace docent::task_control
