#pragma once

#include <memory>
#include <optional>
#include <string>

#include "docent/base/random.h"
#include "docent/messages/request_messages.h"
#include "docent/museum/museum.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/telepresence/tour_votes.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// Takes votes for tours, and tells the robot how they stand ([Minerva2000] 6.4).
class VoteDesk {
 public:
  /// Museum and robot outlive it.
  VoteDesk(RobotLink& robot, const museum::Museum& museum, std::unique_ptr<TourVotes> votes, std::uint64_t seed,
           Time now);

  /// None: it counts.
  [[nodiscard]] Reason take(const VoteMessage& message, Time now);
  /// A round whose tour the robot has taken is over.
  void see(const docent_msgs::RequestBoard& board, Time now);
  /// Now and then: votes that other gateways took. What viewers are to be shown; nullopt: as before.
  [[nodiscard]] std::optional<std::string> look(Time now);
  void forget_before(Time time) { votes_->forget_before(time); }
  /// Why the last vote could not be stored; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  RobotLink& robot_;
  const museum::Museum& museum_;
  std::unique_ptr<TourVotes> votes_;
  Rng rng_;
  Tally tally_;
  std::string shown_;
  std::string fault_;
};

}  // namespace docent::telepresence
