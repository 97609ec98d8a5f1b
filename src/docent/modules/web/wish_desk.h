#pragma once

#include <memory>
#include <string>

#include "docent/messages/request_messages.h"
#include "docent/telepresence/outbox.h"
#include "docent/transport/bus.h"
#include "docent/vocabulary/reason.h"

namespace docent::modules {

/// For the `web` module: wishes from their acknowledgement until they are on the request board
/// (architecture 10.8, 10.9).
class WishDesk {
 public:
  /// The bus outlives it. @param is_shared  other gateways write into the same database
  WishDesk(transport::Bus& bus, std::unique_ptr<telepresence::Outbox> outbox, bool is_shared);

  /// Commits the wish, then tells the robot. None: it may be acknowledged.
  [[nodiscard]] Reason take(docent_msgs::Request wish);
  void see(const docent_msgs::RequestBoard& board);
  /// Tells the robot again what is not on the board yet.
  void resend();
  void forget_before(Time time) { outbox_->forget_before(time); }
  /// Wishes that are open, or on their way to the board.
  [[nodiscard]] std::size_t waiting() const { return open_ + outbox_->pending().size(); }
  /// Why the last wish could not be stored; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  transport::Bus& bus_;
  std::unique_ptr<telepresence::Outbox> outbox_;
  bool is_shared_;
  transport::Publisher<docent_msgs::Request> requests_;
  std::size_t open_ = 0;
  std::string fault_;
};

}  // namespace docent::modules
