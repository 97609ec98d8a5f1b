#include "docent/evaluation/truth_history.h"

#include <algorithm>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr Duration kKept = std::chrono::seconds{20};
constexpr Duration kNear = std::chrono::milliseconds{150};

}  // namespace

Pose2 true_pose(const docent_msgs::TrueState& state) { return {state.x, state.y, Angle::radians(state.theta)}; }

void TruthHistory::add(std::shared_ptr<const docent_msgs::TrueState> state) {
  const Time time = from_message(state->header.stamp);
  if (!states_.empty() && time <= states_.back().time) return;
  states_.push_back({time, std::move(state)});
  while (states_.front().time < time - kKept) states_.pop_front();
}

std::optional<Pose2> TruthHistory::pose_at(Time time) const {
  const auto after = std::lower_bound(states_.begin(), states_.end(), time,
                                      [](const Entry& entry, Time wanted) { return entry.time < wanted; });
  if (after == states_.end()) return std::nullopt;
  if (after->time == time) return true_pose(*after->state);
  if (after == states_.begin()) return std::nullopt;
  const Entry& before = *std::prev(after);
  const double share = to_seconds(time - before.time) / to_seconds(after->time - before.time);
  const Pose2 a = true_pose(*before.state);
  const Pose2 b = true_pose(*after->state);
  return Pose2{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
               Angle::radians(a.theta.radians() + share * (b.theta - a.theta).radians())};
}

const docent_msgs::TrueState* TruthHistory::state_at(Time time) const {
  const docent_msgs::TrueState* nearest = nullptr;
  Duration gap = kNear;
  for (auto entry = states_.rbegin(); entry != states_.rend(); ++entry) {
    const Duration away = std::chrono::abs(entry->time - time);
    if (away <= gap) {
      gap = away;
      nearest = entry->state.get();
    } else if (entry->time < time) {
      break;
    }
  }
  return nearest;
}

}  // namespace docent::evaluation
