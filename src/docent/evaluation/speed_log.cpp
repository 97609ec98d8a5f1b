#include "docent/evaluation/speed_log.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "docent/base/files.h"

namespace docent {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds{200};

}  // namespace

void SpeedLog::add(const TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kTrueState.name) {
    add_state(*static_cast<const docent_msgs::TrueState*>(message.get()), time);
  } else if (name == topics::kAvoidState.name) {
    const auto& avoid = *static_cast<const docent_msgs::AvoidState*>(message.get());
    std::string reason = avoid.reason;
    std::replace(reason.begin(), reason.end(), ',', ';');
    char cap[16];
    std::snprintf(cap, sizeof cap, "%.2f", avoid.speed_cap);
    avoidance_ = avoid.state + "," + cap + "," + reason;
  } else if (name == topics::kGoalState.name) {
    const auto& goal = *static_cast<const docent_msgs::GoalState*>(message.get());
    goal_ = goal.id.empty() ? "idle" : goal.state;
  }
}

void SpeedLog::add_state(const docent_msgs::TrueState& state, Time time) {
  if (!has_truth_) first_ = time;
  if (has_truth_ && time - last_ < kPeriod) return;
  has_truth_ = true;
  last_ = time;
  char row[160];
  std::snprintf(row, sizeof row, "%.2f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,", to_seconds(time - first_), state.x, state.y,
                state.linear, state.distance_m, state.nearest_solid_m, state.nearest_person_m);
  rows_ += row + avoidance_ + "," + goal_ + "\n";
}

Result<void> SpeedLog::save(const std::string& path) const {
  return write_file_atomically(path, "time,x,y,speed,distance,solid,person,state,cap,reason,goal\n" + rows_);
}

}  // namespace docent
