#pragma once

#include <deque>
#include <optional>
#include <string>

#include "docent/base/time.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/documents.h"

namespace docent::telepresence {

/// What specialists look at: the obstacle field with its virtual measurements, the filtered beams, and the log of what
/// happened.
class InsideView {
 public:
  void see(const sensor_msgs::LaserScan& virtual_scan) { virtual_scan_ = virtual_scan; }
  void see(const docent_msgs::PersonBeams& beams) { beams_ = beams; }
  void see(const docent_msgs::Event& event);

  /// What is older than two seconds is shown no more.
  [[nodiscard]] std::string field(Time now) const;
  /// The newest 60 lines, the newest first; nullopt: as before.
  [[nodiscard]] std::optional<std::string> log();

 private:
  sensor_msgs::LaserScan virtual_scan_;
  docent_msgs::PersonBeams beams_;
  std::deque<documents::LogLine> lines_;  ///< the newest first
  bool is_log_new_ = true;
};

}  // namespace docent::telepresence
