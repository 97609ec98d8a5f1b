#include "docent/telepresence/service/web_service.h"

#include <algorithm>
#include <utility>

#include "docent/telepresence/document_json.h"
#include "docent/telepresence/limits/network.h"
#include "docent/telepresence/live_encoding.h"
#include "docent/telepresence/museum_document.h"
#include "docent/telepresence/store/salvage/private_files.h"

namespace docent::telepresence {
namespace {

constexpr Duration kStorePeriod = std::chrono::seconds{10};

StoreQueue::Of whose(Role role) {
  return role == Role::kiosk || role == Role::staff ? StoreQueue::Of::ours : StoreQueue::Of::strangers;
}

RequestSource source_of(Role role) {
  switch (role) {
    case Role::kiosk:
      return RequestSource::kiosk;
    case Role::staff:
      return RequestSource::staff;
    case Role::observer:
    case Role::visitor:
      break;
  }
  return RequestSource::web;
}

/// [m/s] by the name of the mode.
std::map<std::string, double> speeds_of(const museum::Museum& museum) {
  std::map<std::string, double> speeds;
  for (const auto& [name, mode] : museum.modes) speeds[name] = mode.max_speed;
  return speeds;
}

}  // namespace

WebService::WebService(WebServiceParts parts, const museum::Museum& museum, RobotLink& robot, StopRegister& button,
                       Viewers& viewers, Time now)
    : museum_{museum},
      viewers_{viewers},
      database_{std::move(parts.store.database)},
      queue_{*database_, std::move(parts.post), parts.queue},
      max_open_requests_{parts.max_open_requests},
      kept_places_{std::min(parts.kept_places, parts.max_open_requests - 1)},
      max_open_of_address_{parts.max_open_of_address},
      forgets_after_{parts.forgets_after},
      horn_{std::move(parts.horn)},
      operated_{std::move(parts.operated)},
      wishes_{robot, queue_, std::move(parts.store.outbox), std::move(parts.store.pending), parts.is_shared},
      answers_{robot},
      screen_{robot, queue_, std::move(parts.screen), now},
      votes_{robot,      queue_,
             museum,     std::move(parts.store.votes),
             parts.seed, [this](std::string text) { viewers_.show(slots::kVotes, std::move(text)); },
             now},
      operator_{robot, button, std::move(parts.note), speeds_of(museum)},
      counts_{queue_, std::move(parts.store.statistics), std::move(parts.gateway), now},
      backups_{std::move(parts.backups)} {}

void WebService::take(const Caller& caller, const ClientMessage& message, Time now) {
  const ViewerId viewer = caller.id;
  if (operator_.take(caller, message, now)) {
    show_operation();
    return answer_operators(now);
  }
  if (const auto* request = std::get_if<RequestMessage>(&message)) return take_request(caller, *request, now);
  if (const auto* cancel = std::get_if<CancelMessage>(&message)) return take_cancel(caller, *cancel, now);
  if (const auto* vote = std::get_if<VoteMessage>(&message)) return take_vote(caller, *vote, now);
  if (const auto* choice = std::get_if<ChoiceMessage>(&message))
    return answer(viewer, choice->id, answers_.take(*choice, source_of(caller.role)));
  screen_.take(message, phase_, now, [this, viewer, message](const std::string& id, const Reason& why_not) {
    const auto* given = std::get_if<AnswerMessage>(&message);
    if (given != nullptr && why_not.is_none()) counts_.answered(given->id, given->question, given->answer);
    answer(viewer, id, why_not);
  });
}

std::function<void(const Reason&)> WebService::answer_for(ViewerId viewer, std::string id) {
  return [this, viewer, id = std::move(id)](const Reason& why_not) { answer(viewer, id, why_not); };
}

/// The Web does not fill the board: who stands before the robot still gets in.
bool WebService::may_wait(const Caller& caller) const {
  if (caller.role != Role::visitor) return wishes_.waiting() < max_open_requests_;
  return wishes_.waiting() < max_open_requests_ - kept_places_ &&
         wishes_.waiting_of(network_of(caller.address)) < max_open_of_address_;
}

void WebService::take_request(const Caller& caller, const RequestMessage& message, Time now) {
  if (!may_wait(caller)) return answer(caller.id, message.id, ReasonWord::too_many_wait);
  if (const Reason why_not = why_not_in(museum_, message); !why_not.is_none())
    return answer(caller.id, message.id, why_not);
  docent_msgs::Request wish;
  wish.id = message.id;
  wish.source = to_text(source_of(caller.role));
  wish.visitor = message.name;
  wish.kind = to_text(message.kind);
  wish.target = message.target;
  wish.viewpoint = message.viewpoint;
  wish.language = message.language.empty() && !museum_.languages.empty() ? museum_.languages.front() : message.language;
  wishes_.take(std::move(wish), network_of(caller.address), now, answer_for(caller.id, message.id), whose(caller.role));
}

void WebService::take_cancel(const Caller& caller, const CancelMessage& message, Time now) {
  docent_msgs::Request wish;
  wish.id = message.id;
  wish.source = to_text(source_of(caller.role));
  wish.kind = to_text(RequestKind::cancel);
  wish.target = message.request;
  wishes_.take(std::move(wish), network_of(caller.address), now, answer_for(caller.id, message.id), whose(caller.role));
}

void WebService::take_vote(const Caller& caller, const VoteMessage& message, Time now) {
  votes_.take(message, now, [this, viewer = caller.id, id = message.id](const Reason& why_not) {
    if (why_not.is_none()) counts_.voted();
    answer(viewer, id, why_not);
  });
}

void WebService::answer(ViewerId viewer, const std::string& id, const Reason& why_not) {
  viewers_.answer(viewer, why_not.is_none() ? encode_acknowledgement(id) : encode_refusal(id, why_not));
}

void WebService::answer_operators(Time now) {
  for (const auto& [viewer, id, why_not] : operator_.answers(now)) {
    if (!id.empty()) {
      answer(viewer, id, why_not);
    } else if (const auto word = why_not.word()) {
      viewers_.answer(viewer, encode_error(*word));
    }
  }
}

void WebService::steer_on(Time now) {
  operator_.steer_on(now);
  answer_operators(now);
}

void WebService::show_if_new(Kept kept, slots::Slot slot, std::string text) {
  std::string& shown = shown_.at(static_cast<std::size_t>(kept));
  if (std::exchange(shown, text) != text) viewers_.show(slot, std::move(text));
}

void WebService::see(const docent_msgs::MissionState& mission) {
  phase_ = parse<MissionPhase>(mission.phase);
  answers_.see(mission.prompt);
  viewers_.show(slots::kMission, encode_mission(mission));
}

void WebService::see(const docent_msgs::SoundState& sound) {
  is_muted_ = !(sound.volume > 0.0);
  viewers_.show(slots::kSound, encode_sound(sound));
}

void WebService::see(const docent_msgs::Expression& expression) {
  show_if_new(Kept::expression, slots::kExpression, encode_expression(expression));
}

void WebService::see(const docent_msgs::RequestBoard& board, Time now) {
  wishes_.see(board, now);
  votes_.see(board, now);
  counts_.see(board);
  viewers_.show(slots::kBoard, encode_board(board));
}

/// The `sound` module has written the file of this name.
void WebService::honk(Time now) {
  viewers_.show(slots::kHorn, encode_horn(now, is_muted_ ? "" : horn_.file, horn_.duration_s));
}

void WebService::press(int number, Time now) {
  if (number < 1 || number > kButtons) return;
  viewers_.show(slots::kButton, encode_button(now, number));
}

void WebService::look(const PresentHours& hours, std::size_t viewers, Time now) {
  viewers_.show(slots::kHealth, health_.show(viewers, now));
  show_if_new(Kept::hours, slots::kHours, encode_hours(hours.mode, hours.is_open, hours.next_mode, hours.next_at));
  votes_.look(now);
  screen_.look(now);
  wishes_.look(now);
  queue_.look(now);
  look_at_store(now);
}

/// A file that is gone or cut off is found also while nobody stores anything.
void WebService::look_at_store(Time now) {
  if (looked_at_store_ && now - *looked_at_store_ < kStorePeriod) return;
  looked_at_store_ = now;
  backups_.look(seconds_now());
  queue_.put([this] { return database_->look(); },
             [this](const Result<void>& looked) { store_fault_ = looked ? "" : looked.error().message; }, now);
}

void WebService::resend(Time now) {
  wishes_.resend(now);
  answers_.resend();
}

void WebService::show_operation() {
  const documents::OperationMessage document = operator_.document();
  operated_(document);
  show_if_new(Kept::operation, slots::kOperation, json_text(document));
}

void WebService::store_counts(const PresentHours& hours, std::uint64_t accesses, Time now) {
  counts_.asked(accesses);
  counts_.store(hours.mode, now);
}

void WebService::forget_old(Time now) {
  wishes_.forget_before(now - forgets_after_, now);
  votes_.forget_before(now - forgets_after_, now);
}

std::string WebService::fault() const {
  for (const std::string* fault : {&wishes_.fault(), &screen_.fault(), &votes_.fault(), &counts_.fault()})
    if (!fault->empty()) return *fault;
  for (const std::string& fault : {store_fault_, backups_.fault(), database_->notice()})
    if (!fault.empty()) return fault;
  return {};
}

}  // namespace docent::telepresence
