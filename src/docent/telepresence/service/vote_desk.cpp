#include "docent/telepresence/service/vote_desk.h"

#include <algorithm>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/vocabulary/uuid.h"

namespace docent::telepresence {

VoteDesk::VoteDesk(RobotLink& robot, const museum::Museum& museum, std::unique_ptr<TourVotes> votes, std::uint64_t seed,
                   Time now)
    : robot_{robot},
      museum_{museum},
      votes_{std::move(votes)},
      rng_{Rng{seed ^ static_cast<std::uint64_t>(now.nanoseconds)}.stream("votes")} {
  if (auto begun = votes_->begin(make_uuid_v7(now, rng_), now); !begun) fault_ = begun.error().message;
}

Reason VoteDesk::take(const VoteMessage& message, Time now) {
  if (museum_.find_tour(message.tour) == nullptr) return {ReasonWord::no_such_tour, message.tour};
  if (auto stored = votes_->vote(message.voter, message.tour, now); !stored) {
    fault_ = stored.error().message;
    return ReasonWord::not_stored;
  }
  fault_.clear();
  return {};
}

void VoteDesk::see(const docent_msgs::RequestBoard& board, Time now) {
  const bool is_taken = std::any_of(board.requests.begin(), board.requests.end(),
                                    [&](const auto& entry) { return entry.request.id == tally_.round; });
  if (!is_taken || tally_.round.empty()) return;
  auto closed = votes_->close(tally_.round, make_uuid_v7(now, rng_), now);
  if (!closed) fault_ = closed.error().message;
}

std::optional<std::string> VoteDesk::look(Time now) {
  auto tally = votes_->tally();
  if (!tally) {
    fault_ = tally.error().message;
    return std::nullopt;
  }
  tally_ = std::move(*tally);
  std::string text = encode_votes(tally_);
  if (text == shown_) return std::nullopt;
  shown_ = text;
  docent_msgs::Votes message;
  message.header.stamp = to_message(now);
  message.round = tally_.round;
  // In the museum's order, for of two with as many votes the first counts.
  for (const museum::Tour& tour : museum_.tours) {
    const auto place = tally_.counts.find(tour.id);
    if (place == tally_.counts.end()) continue;
    message.tours.push_back(tour.id);
    message.counts.push_back(place->second);
  }
  robot_.tell(std::move(message));
  return text;
}

}  // namespace docent::telepresence
