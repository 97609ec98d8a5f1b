#include "docent/task_control/navigation_goals/error_code.h"

#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {
namespace {

// nav2_msgs/action: FollowPath has 100 to 199, ComputePathToPose 200 to 299, the navigators 9000 to 9999.
constexpr std::uint16_t kFailedToMakeProgress = 105;
constexpr std::uint16_t kGoalOccupied = 206;
constexpr std::uint16_t kNoValidPath = 208;
constexpr std::uint16_t kUnknown = 9000;
constexpr std::uint16_t kTimeout = 9003;

}  // namespace

std::uint16_t error_code_of(const std::string& reason) {
  if (reason.empty()) return 0;
  if (reason == "robot_silent") return kTimeout;
  const auto word = parse<ReasonWord>(reason.substr(0, reason.find(' ')));  // behind it may stand what it is about
  if (!word) return kUnknown;
  switch (*word) {
    case ReasonWord::not_on_free_floor:
      return kGoalOccupied;
    case ReasonWord::no_way:
      return kNoValidPath;
    case ReasonWord::not_reached:
    case ReasonWord::way_blocked:
    case ReasonWord::person_in_way:
    case ReasonWord::obstacle_in_way:
      return kFailedToMakeProgress;
    case ReasonWord::took_too_long:
      return kTimeout;
    default:
      return kUnknown;
  }
}

}  // namespace docent::task_control
