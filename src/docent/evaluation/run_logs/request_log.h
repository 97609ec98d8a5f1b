#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/messages/interaction_messages.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// What people asked for, what the robot told them of it, and what they heard, as CSV. Columns: time [s] since the
/// first truth; what, see below; id, source, kind, target, viewpoint, state and detail, of which a row has those that
/// it needs (commas become semicolons); where the robot truly stood then, x, y [m] and heading [deg].
///
///   asked   a request was sent for the first time, whatever the robot makes of it
///   board   the request board says another state of a request than before; detail: the reason
///   heard   an explanation began; id: its task, target: the exhibit, state: short or long, detail: the tour it is of
///   chosen  single exhibits were put into an order; target: the first one, detail: all stops
class RequestLog {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  void add_board(Time time, const docent_msgs::RequestBoard& board);
  void add_speech(Time time, const docent_msgs::SpeechState& speech);
  void write(Time time, const char* what, const docent_msgs::Request& request, const std::string& state,
             std::string detail);

  Time first_{};
  bool has_truth_ = false;
  double x_ = 0.0, y_ = 0.0, heading_deg_ = 0.0;
  std::set<std::string> asked_;
  std::map<std::string, std::string> states_;  ///< of all requests that were ever on the board
  docent_msgs::Task task_;
  std::string heard_;  ///< id of the line that was heard last
  std::string rows_;
};

}  // namespace docent::evaluation
