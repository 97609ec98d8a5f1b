#pragma once

#include <cstdint>
#include <string>

namespace docent::task_control {

/// What Nav2 would say: the number of its actions' results that comes nearest to why a goal was aborted, so that a
/// client's behaviour tree that looks at them does what it would do for Nav2. 0: none, which is for success alone.
/// @param reason  of GoalEnd
[[nodiscard]] std::uint16_t error_code_of(const std::string& reason);

}  // namespace docent::task_control
