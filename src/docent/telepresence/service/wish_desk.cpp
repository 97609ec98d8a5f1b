#include "docent/telepresence/service/wish_desk.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {
namespace {

constexpr Duration kForTheBoard = std::chrono::seconds{5};
constexpr std::size_t kToldTogether = 24;  // a late reader of requests keeps 32 (transport's commands)

bool is_of_the_house(const docent_msgs::Request& request) {
  const auto source = parse<RequestSource>(request.source);
  return source == RequestSource::kiosk || source == RequestSource::staff;
}

bool is_cancellation(const docent_msgs::Request& request) {
  return parse<RequestKind>(request.kind) == RequestKind::cancel;
}

}  // namespace

void WishDesk::take(docent_msgs::Request wish, const std::string& network, Time now, Answer answer,
                    StoreQueue::Of whom) {
  wish.stamp = to_message(now);
  if (!is_cancellation(wish)) asked_from_.emplace(wish.id, network);
  ++storing_;
  const auto is_new = std::make_shared<bool>(false);
  queue_.put(
      [this, wish, is_new]() -> Result<void> {
        auto put = outbox_->put(wish);
        if (!put) return tl::unexpected<Error>(put.error());
        *is_new = *put;
        return {};
      },
      [this, wish, is_new, whom, now, answer = std::move(answer)](const Result<void>& stored) {
        --storing_;
        fault_ = stored ? "" : stored.error().message;
        if (stored) return was_stored(wish, *is_new, answer);
        if (whom == StoreQueue::Of::ours) {
          unstored_.push_back({wish, answer, now});
          return robot_.tell(wish);
        }
        asked_from_.erase(wish.id);
        answer(ReasonWord::not_stored);
      },
      now, whom);
}

void WishDesk::was_stored(const docent_msgs::Request& wish, bool is_new, const Answer& answer) {
  if (is_new) pending_.push_back(wish);
  robot_.tell(wish);
  answer({});
}

void WishDesk::look(Time now) {
  while (!unstored_.empty() && now - unstored_.front().since > kForTheBoard) {
    const Unstored lost = std::move(unstored_.front());
    unstored_.erase(unstored_.begin());
    asked_from_.erase(lost.wish.id);
    lost.answer(ReasonWord::not_stored);
  }
}

void WishDesk::see(const docent_msgs::RequestBoard& board, Time now) {
  open_ = 0;
  std::set<std::string> closed;
  std::set<std::string> done;
  for (const auto& entry : board.requests) {
    const auto status = parse<RequestStatus>(entry.state);
    const bool is_waiting = status && is_open(*status);
    if (is_waiting) ++open_;
    if (!is_waiting) closed.insert(entry.request.id);
    if (!is_waiting) asked_from_.erase(entry.request.id);
    done.insert(entry.request.id);
  }
  // A cancellation is seen in the state of what it cancels.
  const auto is_done = [&](const docent_msgs::Request& request) {
    return done.contains(request.id) || (is_cancellation(request) && closed.contains(request.target));
  };
  for (const auto& request : pending_)
    if (is_done(request)) done.insert(request.id);
  delivered(done, now);
  const auto there = std::stable_partition(unstored_.begin(), unstored_.end(),
                                           [&](const Unstored& one) { return !is_done(one.wish); });
  const std::vector<Unstored> kept{std::make_move_iterator(there), std::make_move_iterator(unstored_.end())};
  unstored_.erase(there, unstored_.end());
  for (const Unstored& one : kept) one.answer({});
}

void WishDesk::delivered(const std::set<std::string>& ids, Time now) {
  std::vector<std::string> gone;
  std::erase_if(pending_, [&](const auto& request) {
    if (!ids.contains(request.id)) return false;
    gone.push_back(request.id);
    return true;
  });
  if (gone.empty()) return;
  delivered_.insert(gone.begin(), gone.end());
  store(
      [this, gone]() -> Result<void> {
        for (const auto& id : gone)
          if (auto noted = outbox_->delivered(id); !noted) return noted;
        return {};
      },
      now);
}

std::size_t WishDesk::waiting_of(const std::string& network) const {
  return static_cast<std::size_t>(
      std::count_if(asked_from_.begin(), asked_from_.end(), [&](const auto& wish) { return wish.second == network; }));
}

/// What need not succeed: should it fail, a request is told again after a restart, and the board knows it already, or
/// the table stays larger until the next time.
void WishDesk::store(StoreQueue::Work work, Time now) {
  queue_.put(
      std::move(work), [](const Result<void>&) {}, now);
}

void WishDesk::forget_before(Time time, Time now) {
  std::erase_if(pending_, [&](const auto& request) {
    const bool is_old = from_message(request.stamp) < time;
    if (is_old) asked_from_.erase(request.id);
    return is_old;
  });
  store([this, time] { return outbox_->forget_before(time); }, now);
}

void WishDesk::resend(Time now) {
  tell_all(now);
  if (!is_shared_) return;
  delivered_.clear();
  const auto found = std::make_shared<std::vector<docent_msgs::Request>>();
  queue_.put(
      [this, found]() -> Result<void> {
        auto read = outbox_->pending();
        if (!read) return tl::unexpected<Error>(read.error());
        *found = std::move(*read);
        return {};
      },
      [this, found, now](const Result<void>& read) {
        if (!read) {
          fault_ = read.error().message;
          return;
        }
        fault_.clear();
        // What another gateway took is told at once; of what was delivered meanwhile the table did not know yet.
        for (const auto& request : *found) {
          const auto is_it = [&](const auto& known) { return known.id == request.id; };
          if (delivered_.contains(request.id) || std::any_of(pending_.begin(), pending_.end(), is_it)) continue;
          pending_.push_back(request);
          robot_.tell(request);
        }
        // And what another gateway knows to be on the board is no matter of ours any more.
        std::erase_if(pending_, [&](const auto& request) {
          return std::none_of(found->begin(), found->end(),
                              [&](const auto& known) { return known.id == request.id; }) &&
                 from_message(request.stamp) < now;
        });
      },
      now);
}

void WishDesk::tell_all(Time now) {
  // A cancellation whose request nobody knows any more would otherwise be repeated for hours.
  std::set<std::string> given_up;
  for (const auto& request : pending_) {
    const bool is_old = now - from_message(request.stamp) > std::chrono::minutes{1};
    if (is_cancellation(request) && is_old) given_up.insert(request.id);
  }
  delivered(given_up, now);
  // Of a burst the robot hears the last ones alone: the oldest are told, and after them all of the hall and of staff.
  std::size_t others = 0;
  for (const auto& request : pending_)
    if (!is_of_the_house(request) && others++ < kToldTogether) robot_.tell(request);
  for (const auto& request : pending_)
    if (is_of_the_house(request)) robot_.tell(request);
  for (const auto& one : unstored_) robot_.tell(one.wish);
}

}  // namespace docent::telepresence
