#include "docent/telepresence/service/wish_desk.h"

#include <set>
#include <utility>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {
namespace {

bool is_cancellation(const docent_msgs::Request& request) {
  return parse<RequestKind>(request.kind) == RequestKind::cancel;
}

}  // namespace

Reason WishDesk::take(docent_msgs::Request wish, Time now) {
  wish.stamp = to_message(now);
  if (auto stored = outbox_->put(wish); !stored) {
    fault_ = stored.error().message;
    return ReasonWord::not_stored;
  }
  fault_.clear();
  robot_.tell(std::move(wish));
  return {};
}

void WishDesk::see(const docent_msgs::RequestBoard& board) {
  open_ = 0;
  std::set<std::string> closed;
  for (const auto& entry : board.requests) {
    const auto status = parse<RequestStatus>(entry.state);
    const bool is_waiting = status && is_open(*status);
    if (is_waiting) ++open_;
    if (!is_waiting) closed.insert(entry.request.id);
    outbox_->delivered(entry.request.id);
  }
  // A cancellation is seen in the state of what it cancels.
  std::vector<std::string> done;
  for (const auto& request : outbox_->pending()) {
    if (is_cancellation(request) && closed.contains(request.target)) done.push_back(request.id);
  }
  for (const auto& id : done) outbox_->delivered(id);
}

void WishDesk::resend(Time now) {
  if (is_shared_) {
    if (auto read = outbox_->refresh(); !read) fault_ = read.error().message;
  }
  // A cancellation whose request nobody knows any more would otherwise be repeated for hours.
  std::vector<std::string> given_up;
  for (const auto& request : outbox_->pending()) {
    const bool is_old = now - from_message(request.stamp) > std::chrono::minutes{1};
    if (is_cancellation(request) && is_old) given_up.push_back(request.id);
  }
  for (const auto& id : given_up) outbox_->delivered(id);
  for (const auto& request : outbox_->pending()) robot_.tell(request);
}

}  // namespace docent::telepresence
