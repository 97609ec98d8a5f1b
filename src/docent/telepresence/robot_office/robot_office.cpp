#include "docent/telepresence/robot_office/robot_office.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "docent/telepresence/client_message.h"

namespace docent::telepresence {

std::string fault_of(const documents::RobotGoal& goal) {
  constexpr double kFarthest = 10'000.0;  // [m] as the mission allows
  constexpr double kLargest = 100.0;      // [rad] likewise
  if (!is_uuid7(goal.id)) return "id must be a UUID of version 7";
  if (!(std::abs(goal.x) < kFarthest && std::abs(goal.y) < kFarthest)) return "x, y is no place";
  if (!(std::abs(goal.heading) < kLargest)) return "heading is no angle";
  return {};
}

std::string fault_of(const documents::OfficeWish& wish) {
  constexpr std::array kKinds{"deliver", "tidy", "confirm", "stop"};
  constexpr std::size_t kLongestRoom = 64;  // [bytes]
  if (!is_uuid7(wish.id)) return "id must be a UUID of version 7";
  if (std::find(kKinds.begin(), kKinds.end(), wish.kind) == kKinds.end())
    return "kind must be deliver, tidy, confirm or stop";
  if (wish.room.size() > kLongestRoom) return "room is no room's id";
  if (wish.kind == kKinds.front() && wish.room.empty()) return "a delivery needs a room";
  return {};
}

std::string withdrawal_id(std::string id) {
  // The last digit of the counter behind the version, in which no two goals of a caller differ alone.
  constexpr std::size_t kDigit = 17;
  if (id.size() > kDigit) id[kDigit] = id[kDigit] == '0' ? '1' : '0';
  return id;
}

}  // namespace docent::telepresence
