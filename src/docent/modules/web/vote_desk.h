#pragma once

#include <memory>
#include <optional>
#include <string>

#include "docent/base/random.h"
#include "docent/messages/request_messages.h"
#include "docent/museum/museum.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/tour_votes.h"
#include "docent/transport/bus.h"
#include "docent/vocabulary/reason.h"

namespace docent::modules {

/// For the `web` module: takes votes for tours, and tells the robot how they stand ([Minerva2000] 6.4).
class VoteDesk {
 public:
  /// Museum, bus and votes outlive it.
  VoteDesk(transport::Bus& bus, const museum::Museum& museum, std::unique_ptr<telepresence::TourVotes> votes,
           std::uint64_t seed);

  /// None: it counts.
  [[nodiscard]] Reason take(const telepresence::VoteMessage& message);
  /// A round whose tour the robot has taken is over.
  void see(const docent_msgs::RequestBoard& board);
  /// Now and then: votes that other gateways took. What viewers are to be shown; nullopt: as before.
  [[nodiscard]] std::optional<std::string> look();
  void forget_before(Time time) { votes_->forget_before(time); }
  /// Why the last vote could not be stored; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  transport::Bus& bus_;
  const museum::Museum& museum_;
  std::unique_ptr<telepresence::TourVotes> votes_;
  Rng rng_;
  transport::Publisher<docent_msgs::Votes> publisher_;
  telepresence::Tally tally_;
  std::string shown_;
  std::string fault_;
};

}  // namespace docent::modules
