#include "docent/evaluation/run_logs/office_log.h"

#include <fmt/format.h>

#include <set>

#include "docent/base/files.h"
#include "docent/messages/topics.h"

namespace docent::evaluation {

void OfficeLog::add_row(Time time, const std::string& rest) {
  rows_ += fmt::format("{:.2f},{}\n", has_truth_ ? to_seconds(time - first_) : 0.0, rest);
}

void OfficeLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kTrueState.name) {
    const auto& truth = *static_cast<const docent_msgs::TrueState*>(message.get());
    if (!has_truth_) first_ = time;
    has_truth_ = true;
    robot_ = {truth.x, truth.y};
  } else if (name == topics::kOfficeState.name) {
    const auto& state = *static_cast<const docent_msgs::OfficeState*>(message.get());
    const Point2 at = state.points ? Point2{state.x, state.y} : robot_;
    add_row(time, fmt::format("state,{},{:.3f},{:.3f},{} {},0,{},{},{}", state.phase, at.x, at.y, state.kind,
                              state.room, state.found, state.picked_up, state.left));
  } else if (name == topics::kSeenThings.name) {
    const auto& seen = *static_cast<const docent_msgs::SeenThings*>(message.get());
    std::set<std::uint32_t> there;
    for (const docent_msgs::SeenThing& thing : seen.things) {
      there.insert(thing.id);
      const auto known = named_.find(thing.id);
      if (known != named_.end() && known->second == thing.object) continue;
      named_[thing.id] = thing.object;
      add_row(time,
              fmt::format("thing,{},{:.3f},{:.3f},{},{},0,0,0", thing.object, thing.x, thing.y, thing.id, thing.looks));
    }
    for (auto thing = named_.begin(); thing != named_.end();) {
      if (there.contains(thing->first)) {
        ++thing;
        continue;
      }
      add_row(time, fmt::format("gone,{},0,0,{},0,0,0,0", thing->second, thing->first));
      thing = named_.erase(thing);
    }
  }
}

Result<void> OfficeLog::save(const std::string& path) const {
  return write_file_atomically(path, "time,what,name,x,y,about,looks,found,picked_up,left\n" + rows_);
}

}  // namespace docent::evaluation
