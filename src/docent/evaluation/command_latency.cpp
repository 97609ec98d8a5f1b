#include "docent/evaluation/command_latency.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "docent/messages/conversions.h"

namespace docent::evaluation {

namespace {

constexpr Duration kPatience = std::chrono::seconds{2};

bool is_scan(std::string_view topic) {
  for (const char* const scanner : {"front", "rear", "left", "right"})
    if (topic == topics::scan_topic(scanner).name) return true;
  return false;
}

}  // namespace

void CommandLatency::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (is_scan(name)) {
    sweeps_.push_back(from_message(static_cast<const sensor_msgs::LaserScan*>(message.get())->header.stamp));
    settle(time - kPatience);
  } else if (name == topics::kAvoidState.name) {
    const auto& choice = *static_cast<const docent_msgs::AvoidState*>(message.get());
    choices_.push_back({from_message(choice.header.stamp), choice.linear, choice.angular});
  } else if (name == topics::kCommandVelocity.name) {
    const auto& twist = *static_cast<const geometry_msgs::Twist*>(message.get());
    told_.push_back({time, twist.linear.x, twist.angular.z});
  }
}

void CommandLatency::settle(Time time) {
  constexpr double kSame = 1e-9;
  while (!sweeps_.empty() && sweeps_.front() < time) {
    const Time seen = sweeps_.front();
    sweeps_.pop_front();
    // Later choices know the sweep as well: whichever reaches the base first.
    const Command* first = nullptr;
    for (const Command& choice : choices_) {
      if (first != nullptr && choice.time >= first->time) break;
      if (choice.time < seen) continue;
      const auto says_it = [&](const Command& told) {
        return told.time >= choice.time && std::abs(told.linear - choice.linear) < kSame &&
               std::abs(told.angular - choice.angular) < kSame;
      };
      const auto found = std::find_if(told_.begin(), told_.end(), says_it);
      if (found == told_.end() || found->time - seen > kPatience) continue;
      if (first == nullptr || found->time < first->time) first = &*found;
    }
    if (first == nullptr) {
      ++unanswered_;
    } else {
      latencies_.add(to_seconds(first->time - seen));
    }
  }
  const auto is_over = [&](const Command& command) { return command.time < time; };
  std::erase_if(choices_, is_over);
  std::erase_if(told_, is_over);
}

}  // namespace docent::evaluation
