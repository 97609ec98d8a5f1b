#include "docent/evaluation/run_logs/request_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "docent/base/files.h"
#include "docent/messages/topics.h"
#include "docent/messages/truth_messages.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::evaluation {

void RequestLog::write(Time time, const char* what, const docent_msgs::Request& request, const std::string& state,
                       std::string detail) {
  std::replace(detail.begin(), detail.end(), ',', ';');
  std::replace(detail.begin(), detail.end(), '\n', ' ');
  rows_ += fmt::format("{:.2f},{},{},{},{},{},{},{},{},{:.3f},{:.3f},{:.1f}\n",
                       has_truth_ ? to_seconds(time - first_) : 0.0, what, request.id, request.source, request.kind,
                       request.target, request.viewpoint, state, detail, x_, y_, heading_deg_);
}

void RequestLog::add_board(Time time, const docent_msgs::RequestBoard& board) {
  for (const docent_msgs::RequestState& entry : board.requests) {
    std::string& state = states_[entry.request.id];
    if (state == entry.state) continue;
    state = entry.state;
    write(time, "board", entry.request, entry.state, entry.reason);
  }
}

void RequestLog::add_speech(Time time, const docent_msgs::SpeechState& speech) {
  if (parse<SpeechStatus>(speech.state) != SpeechStatus::speaking || speech.id == heard_) return;
  const std::size_t slash = speech.id.rfind('/');
  if (slash == std::string::npos || speech.id.substr(0, slash) != task_.id) return;
  const std::string line = speech.id.substr(slash + 1);
  if (line != "short" && line != "long") return;
  heard_ = speech.id;
  docent_msgs::Request shown;
  shown.id = task_.id;
  shown.kind = to_text(RequestKind::exhibit);
  shown.target = task_.exhibit_id;
  write(time, "heard", shown, line, task_.tour_id);
}

void RequestLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const auto is = [name = std::string_view{topic.name}](const auto& wanted) { return name == wanted.name; };
  const auto as = [&message]<class T>(const Topic<T>& /*wanted*/) -> const T& {
    return *static_cast<const T*>(message.get());
  };
  if (is(topics::kTrueState)) {
    const docent_msgs::TrueState& truth = as(topics::kTrueState);
    if (!has_truth_) first_ = time;
    has_truth_ = true;
    x_ = truth.x;
    y_ = truth.y;
    heading_deg_ = truth.theta * 180.0 / std::numbers::pi;
  } else if (is(topics::kRequest)) {
    const docent_msgs::Request& request = as(topics::kRequest);
    if (asked_.insert(request.id).second) write(time, "asked", request, "", "");
  } else if (is(topics::kRequestBoard)) {
    add_board(time, as(topics::kRequestBoard));
  } else if (is(topics::kTask)) {
    task_ = as(topics::kTask);
  } else if (is(topics::kSpeechState)) {
    add_speech(time, as(topics::kSpeechState));
  } else if (is(topics::kEvent) && parse<EventKind>(as(topics::kEvent).kind) == EventKind::order_chosen) {
    docent_msgs::Request first;
    first.kind = to_text(RequestKind::exhibit);
    first.target = as(topics::kEvent).subject;
    write(time, "chosen", first, "", as(topics::kEvent).detail);
  }
}

Result<void> RequestLog::save(const std::string& path) const {
  return write_file_atomically(path, "time,what,id,source,kind,target,viewpoint,state,detail,x,y,heading\n" + rows_);
}

}  // namespace docent::evaluation
