#include "docent/modules/office/office_wishes.h"

#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/vocabulary/uuid.h"

namespace docent::modules {
namespace {

constexpr Duration kResend = std::chrono::seconds{2};

}  // namespace

OfficeWishes::OfficeWishes(transport::Bus& bus, const Rng& rng, std::function<void(bool, const std::string&)> over)
    : bus_{bus}, rng_{rng}, over_{std::move(over)}, requests_{bus.publisher(topics::kRequest)} {
  bus_.subscribe<docent_msgs::RequestBoard>(topics::kRequestBoard, [this](const auto& board) { read(board); });
}

docent_msgs::Request OfficeWishes::request_of(RequestKind kind, std::string target) {
  docent_msgs::Request request;
  request.id = make_uuid_v7(bus_.now(), rng_);
  request.source = to_text(RequestSource::staff);
  request.visitor = "office";
  request.kind = to_text(kind);
  request.target = std::move(target);
  return request;
}

void OfficeWishes::send(docent_msgs::Request request) {
  request.stamp = to_message(bus_.now());
  requests_.publish(std::move(request));
}

void OfficeWishes::make(RequestKind kind, std::string target) {
  wish_ = request_of(kind, std::move(target));
  is_on_board_ = false;
  next_send_ = bus_.now() + kResend;
  send(*wish_);
}

void OfficeWishes::withdraw() {
  if (!wish_) return;
  withdrawn_.push_back(request_of(RequestKind::cancel, wish_->id));
  send(withdrawn_.back());
  wish_.reset();
}

void OfficeWishes::tick() {
  if (bus_.now() < next_send_) return;
  next_send_ = bus_.now() + kResend;
  if (wish_ && !is_on_board_) send(*wish_);
  for (const docent_msgs::Request& gone : withdrawn_) send(gone);
}

void OfficeWishes::read(const docent_msgs::RequestBoard& board) {
  for (const docent_msgs::RequestState& entry : board.requests) {
    const auto status = parse<RequestStatus>(entry.state);
    if (!status) continue;
    if (!is_open(*status)) {
      std::erase_if(withdrawn_, [&](const docent_msgs::Request& gone) {
        return gone.target == entry.request.id || gone.id == entry.request.id;
      });
    }
    if (!wish_ || entry.request.id != wish_->id) continue;
    is_on_board_ = true;
    if (is_open(*status)) continue;
    wish_.reset();
    return over_(*status == RequestStatus::fulfilled, entry.reason);
  }
}

}  // namespace docent::modules
