#pragma once

#include <memory>
#include <string>
#include <utility>

#include "docent/messages/request_messages.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// Wishes from their acknowledgement until they are on the request board
/// (architecture 10.8, 10.9).
class WishDesk {
 public:
  /// The robot outlives it. @param is_shared  other gateways write into the same database
  WishDesk(RobotLink& robot, std::unique_ptr<Outbox> outbox, bool is_shared)
      : robot_{robot}, outbox_{std::move(outbox)}, is_shared_{is_shared} {}

  /// Commits the wish, then tells the robot. None: it may be acknowledged.
  [[nodiscard]] Reason take(docent_msgs::Request wish, Time now);
  void see(const docent_msgs::RequestBoard& board);
  /// Tells the robot again what is not on the board yet.
  void resend(Time now);
  void forget_before(Time time) { outbox_->forget_before(time); }
  /// Wishes that are open, or on their way to the board.
  [[nodiscard]] std::size_t waiting() const { return open_ + outbox_->pending().size(); }
  /// Why the last wish could not be stored; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  RobotLink& robot_;
  std::unique_ptr<Outbox> outbox_;
  bool is_shared_;
  std::size_t open_ = 0;
  std::string fault_;
};

}  // namespace docent::telepresence
