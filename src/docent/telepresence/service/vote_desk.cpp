#include "docent/telepresence/service/vote_desk.h"

#include <algorithm>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/vocabulary/uuid.h"

namespace docent::telepresence {

VoteDesk::VoteDesk(RobotLink& robot, StoreQueue& queue, const museum::Museum& museum, std::unique_ptr<TourVotes> votes,
                   std::uint64_t seed, Show show, Time now)
    : robot_{robot},
      queue_{queue},
      museum_{museum},
      votes_{std::move(votes)},
      rng_{Rng{seed ^ static_cast<std::uint64_t>(now.nanoseconds)}.stream("votes")},
      show_{std::move(show)} {
  begin(now);
}

void VoteDesk::begin(Time now) {
  store([this, round = make_uuid_v7(now, rng_), now] { return votes_->begin(round, now); }, now);
}

void VoteDesk::store(StoreQueue::Work work, Time now) {
  queue_.put(
      std::move(work),
      [this](const Result<void>& stored) {
        if (!stored) fault_ = stored.error().message;
      },
      now);
}

void VoteDesk::take(const VoteMessage& message, Time now, Answer answer) {
  if (museum_.find_tour(message.tour) == nullptr) return answer({ReasonWord::no_such_tour, message.tour});
  queue_.put([this, message, now] { return votes_->vote(message.voter, message.tour, now); },
             [this, answer = std::move(answer)](const Result<void>& stored) {
               fault_ = stored ? "" : stored.error().message;
               answer(stored ? Reason{} : Reason{ReasonWord::not_stored});
             },
             now, StoreQueue::Of::strangers);
}

void VoteDesk::see(const docent_msgs::RequestBoard& board, Time now) {
  const bool is_taken = std::any_of(board.requests.begin(), board.requests.end(),
                                    [&](const auto& entry) { return entry.request.id == tally_.round; });
  if (!is_taken || tally_.round.empty()) return;
  store([this, round = tally_.round, next = make_uuid_v7(now, rng_), now] { return votes_->close(round, next, now); },
        now);
  tally_.round.clear();  // until it is read again: closed once is enough
}

void VoteDesk::look(Time now) {
  if (is_looking_) return;
  is_looking_ = true;
  const auto tally = std::make_shared<Tally>();
  queue_.put(
      [this, tally]() -> Result<void> {
        auto read = votes_->tally();
        if (!read) return tl::unexpected<Error>(read.error());
        *tally = std::move(*read);
        return {};
      },
      [this, tally, now](const Result<void>& read) {
        is_looking_ = false;
        if (!read) {
          fault_ = read.error().message;
          return;
        }
        fault_.clear();
        if (tally->round.empty()) begin(now);  // there was nobody to begin it with
        show(std::move(*tally), now);
      },
      now);
}

void VoteDesk::show(Tally tally, Time now) {
  tally_ = std::move(tally);
  std::string text = encode_votes(tally_);
  if (text == shown_) return;
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
  show_(std::move(text));
}

void VoteDesk::forget_before(Time time, Time now) {
  store([this, time] { return votes_->forget_before(time); }, now);
}

}  // namespace docent::telepresence
