#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "docent/messages/request_messages.h"
#include "docent/telepresence/outbox.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/telepresence/store/store_queue.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// Wishes from their acknowledgement until they are on the request board
/// (architecture 10.8, 10.9).
class WishDesk {
 public:
  using Answer = std::function<void(const Reason& why_not)>;

  /// Robot and queue outlive it; the outbox is used on the queue's thread, until that has ended.
  /// @param pending  what lay in the outbox when it was opened
  /// @param is_shared  other gateways write into the same database
  WishDesk(RobotLink& robot, StoreQueue& queue, std::unique_ptr<Outbox> outbox,
           std::vector<docent_msgs::Request> pending, bool is_shared)
      : robot_{robot}, queue_{queue}, outbox_{std::move(outbox)}, pending_{std::move(pending)}, is_shared_{is_shared} {}

  /// Commits the wish, then tells the robot, then answers. None: it may be acknowledged. Where the store takes nothing,
  /// a wish of the hall or of staff is told to the robot all the same, and is acknowledged once it stands on the board:
  /// that is on the robot's own disk.
  /// @param network  of who asks (limits/network.h)
  void take(docent_msgs::Request wish, const std::string& network, Time now, Answer answer,
            StoreQueue::Of whom = StoreQueue::Of::strangers);
  /// Every second: who waits for the board in vain is told so.
  void look(Time now);
  void see(const docent_msgs::RequestBoard& board, Time now);
  /// Tells the robot again what is not on the board yet.
  void resend(Time now);
  void forget_before(Time time, Time now);
  /// Wishes that are open, on their way to the disk, or from there to the board.
  [[nodiscard]] std::size_t waiting() const { return open_ + pending_.size() + storing_ + unstored_.size(); }
  /// Likewise, of those that came from there through this gateway.
  [[nodiscard]] std::size_t waiting_of(const std::string& network) const;
  /// Why the last wish could not be stored; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  /// A wish that the store did not take and that is not on the board yet.
  struct Unstored {
    docent_msgs::Request wish;
    Answer answer;
    Time since;
  };
  void store(StoreQueue::Work work, Time now);
  void was_stored(const docent_msgs::Request& wish, bool is_new, const Answer& answer);
  void delivered(const std::set<std::string>& ids, Time now);
  void tell_all(Time now);

  RobotLink& robot_;
  StoreQueue& queue_;
  std::unique_ptr<Outbox> outbox_;
  std::vector<docent_msgs::Request> pending_;  ///< not on the board yet, the oldest first
  bool is_shared_;
  std::size_t open_ = 0;
  std::size_t storing_ = 0;
  std::map<std::string, std::string> asked_from_;  ///< of the wishes that wait: their networks by their ids
  std::set<std::string> delivered_;                ///< since the outbox was last read
  std::vector<Unstored> unstored_;                 ///< of the hall and of staff, the oldest first
  std::string fault_;
};

}  // namespace docent::telepresence
