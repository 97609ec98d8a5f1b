#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/messages/truth_messages.h"

namespace docent::evaluation {

/// Tracks are judged and persons counted within this distance of the robot's true place [m].
inline constexpr double kJudgedRange = 5.0;
/// A track is right when a person is so near to it [m].
inline constexpr double kMatchRange = 0.5;
/// A person counts as visible when at least so many beams of the sweep ended on them.
inline constexpr int kVisibleBeams = 3;

/// Which people were found and which tracks are right: one to one, nearest pairs first.
struct PeopleMatch {
  std::vector<std::optional<std::size_t>> track_of;   ///< [people]
  std::vector<std::optional<std::size_t>> person_of;  ///< [tracks]
};

/// @param tracks  [m], world. Every person may be matched, visible or not. O(people * tracks).
[[nodiscard]] PeopleMatch match_people(const docent_msgs::TrueState& truth, std::span<const Point2> tracks);

/// Beams that ended on a person; where a recording does not tell, enough when the person was met at all.
[[nodiscard]] int beams_on(const docent_msgs::TrueState& truth, std::size_t person);

}  // namespace docent::evaluation
