#include "docent/evaluation/run_logs/event_log.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>

#include "docent/base/files.h"
#include "docent/evaluation/deployment_evaluator.h"

namespace docent::evaluation {

void EventLog::write(Time time, const char* source, std::string kind, std::string subject, std::string detail,
                     double value) {
  for (std::string* text : {&kind, &subject, &detail}) {
    std::replace(text->begin(), text->end(), ',', ';');
    std::replace(text->begin(), text->end(), '\n', ' ');
  }
  std::array<char, 64> since{};
  std::snprintf(since.data(), since.size(), "%.2f", has_truth_ ? to_seconds(time - first_) : 0.0);
  std::array<char, 128> rest{};
  std::snprintf(rest.data(), rest.size(), "%.3f,%.3f,%.3f,%s,%.1f", value, x_, y_, gaze_at_.c_str(), gaze_deg_);
  rows_ +=
      std::string{since.data()} + "," + source + "," + kind + "," + subject + "," + detail + "," + rest.data() + "\n";
}

void EventLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const auto is = [name = std::string_view{topic.name}](const auto& wanted) { return name == wanted.name; };
  const auto as = [&message]<class T>(const Topic<T>& /*wanted*/) -> const T& {
    return *static_cast<const T*>(message.get());
  };
  if (is(topics::kTrueState)) {
    if (!has_truth_) first_ = time;
    has_truth_ = true;
    x_ = as(topics::kTrueState).x;
    y_ = as(topics::kTrueState).y;
  } else if (is(topics::kGaze)) {
    gaze_at_ = as(topics::kGaze).at;
    gaze_deg_ = as(topics::kGaze).bearing * 180.0 / std::numbers::pi;
  } else if (is(topics::kEvent)) {
    const docent_msgs::Event& event = as(topics::kEvent);
    write(time, "event", event.kind, event.subject, event.detail, event.value);
  } else if (is(topics::kReaction)) {
    const docent_msgs::Reaction& reaction = as(topics::kReaction);
    write(time, "reaction", reaction.step, reaction.goal_id, reaction.cause, reaction.after);
  } else if (is(topics::kGoalState)) {
    const docent_msgs::GoalState& goal = as(topics::kGoalState);
    if (goal.detour.empty() || goal.detour == detour_) return;
    detour_ = goal.detour;
    write(time, "way", goal.detour, goal.id, "", goal.detour_extra);
  } else if (is(topics::kSay)) {
    write(time, "say", as(topics::kSay).mood, as(topics::kSay).id, as(topics::kSay).text, 0.0);
  } else if (is(topics::kTrueOffer)) {
    write(time, "scenario", as(topics::kTrueOffer).kind, as(topics::kTrueOffer).subject, "", 0.0);
  } else if (is(topics::kTrueContact)) {
    const docent_msgs::TrueContact& touch = as(topics::kTrueContact);
    write(time, "contact", touch.kind, touch.what, is_contact(touch) ? "counts" : "excused", touch.robot_speed);
  }
}

Result<void> EventLog::save(const std::string& path) const {
  return write_file_atomically(path, "time,source,kind,subject,detail,value,x,y,gaze,bearing\n" + rows_);
}

}  // namespace docent::evaluation
