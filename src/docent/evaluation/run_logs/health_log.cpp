#include "docent/evaluation/run_logs/health_log.h"

#include <algorithm>
#include <cstdio>

#include "docent/base/files.h"

namespace docent::evaluation {

void HealthLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kTrueState.name && !has_truth_) {
    has_truth_ = true;
    first_ = time;
  }
  if (name != topics::kHealth.name) return;
  const auto& health = *static_cast<const docent_msgs::Health*>(message.get());
  std::string reason = health.reason;
  std::replace(reason.begin(), reason.end(), ',', ';');
  std::string said = health.state + "," + reason;
  std::string& last = last_[health.module];
  if (said == last) return;
  char since[32];
  std::snprintf(since, sizeof since, "%.2f", has_truth_ ? to_seconds(time - first_) : 0.0);
  rows_ += std::string{since} + "," + health.module + "," + said + "\n";
  last = std::move(said);
}

Result<void> HealthLog::save(const std::string& path) const {
  return write_file_atomically(path, "time,module,state,reason\n" + rows_);
}

}  // namespace docent::evaluation
