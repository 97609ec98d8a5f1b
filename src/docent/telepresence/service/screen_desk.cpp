#include "docent/telepresence/service/screen_desk.h"

#include <utility>

#include "docent/messages/conversions.h"

namespace docent::telepresence {

ScreenDesk::ScreenDesk(RobotLink& robot, StoreQueue& queue, Means means, Time now)
    : robot_{robot}, queue_{queue}, means_{std::move(means)} {
  robot_.tell(docent_msgs::ButtonLamps{{to_message(now), ""}, {}});
}

void ScreenDesk::take(const ClientMessage& message, std::optional<MissionPhase> phase, Time now, Answer answer) {
  if (const auto* lamps = std::get_if<LampsMessage>(&message)) {
    heard_ = now;
    light(lamps->lit, now);
  } else if (const auto* given = std::get_if<AnswerMessage>(&message)) {
    queue_.put([this, given = *given, now] { return means_.keep_answer(given, now); },
               [this, id = given->id, answer = std::move(answer)](const Result<void>& kept) {
                 fault_ = kept ? "" : kept.error().message;
                 answer(id, kept ? Reason{} : Reason{ReasonWord::not_stored});
               },
               now);
  } else if (const auto* wanted = std::get_if<HelpMessage>(&message)) {
    answer(wanted->id, help(*wanted, phase));
  } else if (const auto* unwanted = std::get_if<SkipMessage>(&message)) {
    answer(unwanted->id, skip(*unwanted, phase, now));
  }
}

Reason ScreenDesk::help(const HelpMessage& message, std::optional<MissionPhase> phase) {
  const bool has_time =
      phase == MissionPhase::idle || phase == MissionPhase::waiting || phase == MissionPhase::charging;
  if (!has_time) return ReasonWord::busy;
  robot_.tell(docent_msgs::Say{message.id, means_.help_text(message.language), message.language, to_text(Mood::happy)});
  return {};
}

Reason ScreenDesk::skip(const SkipMessage& message, std::optional<MissionPhase> phase, Time now) {
  const bool is_under_way =
      phase == MissionPhase::driving || phase == MissionPhase::explaining || phase == MissionPhase::asking;
  if (!is_under_way) return ReasonWord::no_such_request;
  docent_msgs::Request wish;
  wish.id = message.id;
  wish.stamp = to_message(now);
  wish.source = to_text(RequestSource::kiosk);
  wish.kind = to_text(RequestKind::skip);
  wish.target = message.exhibit;
  robot_.tell(std::move(wish));
  return {};
}

void ScreenDesk::light(const std::vector<int>& lit, Time now) {
  if (lit == lit_) return;
  lit_ = lit;
  robot_.tell(docent_msgs::ButtonLamps{{to_message(now), ""}, {lit.begin(), lit.end()}});
}

void ScreenDesk::look(Time now) {
  constexpr Duration kLampsSilent = std::chrono::seconds{12};  // the page says its lamps every 5 s
  if (now - heard_ > kLampsSilent) light({}, now);
}

}  // namespace docent::telepresence
