#include "docent/task_control/navigation_goals/request_id.h"

#include <cstdio>

namespace docent::task_control {

std::string request_id(Time time, const GoalId& goal, int number) {
  std::uint64_t random = 0;
  for (std::size_t i = 0; i < 8; ++i) random = (random << 8U) | goal.at(i);
  const auto ms = static_cast<std::uint64_t>(time.nanoseconds / 1'000'000) & 0xFFFF'FFFF'FFFFU;
  char text[37];
  std::snprintf(text, sizeof text, "%08x-%04x-7%03x-%04x-%012llx", static_cast<unsigned>(ms >> 16U),
                static_cast<unsigned>(ms & 0xFFFFU), static_cast<unsigned>(number) & 0xFFFU,
                static_cast<unsigned>(0x8000U | ((random >> 48U) & 0x3FFFU)),
                static_cast<unsigned long long>(random & 0xFFFF'FFFF'FFFFU));
  return text;
}

}  // namespace docent::task_control
