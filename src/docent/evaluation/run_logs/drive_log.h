#pragma once

#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/messages/driving_messages.h"
#include "docent/messages/truth_messages.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// How the robot truly drives beside what `avoid` says of it, as CSV with a row for every true state (10 Hz): time [s]
/// since the first truth; true x, y [m], heading [deg], speed [m/s] and turn rate [rad/s]; distance driven [m];
/// contacts, bumps by people and area violations so far; room to the nearest person and to the nearest solid [m];
/// whether a scanner that lies leaves out something near (0, 1); avoid's state, speed cap [m/s] and reason (commas in
/// it become semicolons).
class DriveLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  void add_row(const docent_msgs::TrueState& truth, Time time);

  Time first_{};
  bool has_truth_ = false;
  bool was_inside_ = true;
  int contacts_ = 0;
  int bumps_ = 0;
  int violations_ = 0;
  bool leaves_out_ = false;
  docent_msgs::AvoidState avoid_;
  std::string reason_;
  std::string rows_;
};

}  // namespace docent::evaluation
