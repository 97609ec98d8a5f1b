#pragma once

#include <functional>
#include <memory>
#include <string>

#include "docent/base/random.h"
#include "docent/messages/request_messages.h"
#include "docent/museum/museum.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/telepresence/store/store_queue.h"
#include "docent/telepresence/tour_votes.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// Takes votes for tours, and tells the robot how they stand ([Minerva2000] 6.4).
class VoteDesk {
 public:
  using Answer = std::function<void(const Reason& why_not)>;
  using Show = std::function<void(std::string text)>;

  /// Museum, robot and queue outlive it; the votes are used on the queue's thread, until that has ended.
  /// @param show  told what viewers are to be shown, whenever that is new
  VoteDesk(RobotLink& robot, StoreQueue& queue, const museum::Museum& museum, std::unique_ptr<TourVotes> votes,
           std::uint64_t seed, Show show, Time now);

  /// Answers once it is stored. None: it counts.
  void take(const VoteMessage& message, Time now, Answer answer);
  /// A round whose tour the robot has taken is over.
  void see(const docent_msgs::RequestBoard& board, Time now);
  /// Now and then: reads how the votes stand, also those that other gateways took.
  void look(Time now);
  void forget_before(Time time, Time now);
  /// Why the last vote could not be stored; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  void begin(Time now);
  void store(StoreQueue::Work work, Time now);
  void show(Tally tally, Time now);

  RobotLink& robot_;
  StoreQueue& queue_;
  const museum::Museum& museum_;
  std::unique_ptr<TourVotes> votes_;
  Rng rng_;
  const Show show_;
  bool is_looking_ = false;
  Tally tally_;
  std::string shown_;
  std::string fault_;
};

}  // namespace docent::telepresence
