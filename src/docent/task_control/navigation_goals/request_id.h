#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "docent/base/time.h"

namespace docent::task_control {

/// By which a client knows its goal: random bytes, as ROS 2's actions have them.
using GoalId = std::array<std::uint8_t, 16>;

/// A UUID of version 7 (RFC 9562), the same for the same arguments: its time is `time`, its random bits are the goal's
/// first 62, and `number` stands where the standard allows a counter.
/// @param number  of the request among those of the goal, 0..4095
[[nodiscard]] std::string request_id(Time time, const GoalId& goal, int number);

}  // namespace docent::task_control
