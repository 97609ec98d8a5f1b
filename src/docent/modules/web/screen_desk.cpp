#include "docent/modules/web/screen_desk.h"

#include "docent/interaction/speech/sentences.h"
#include "docent/messages/conversions.h"

namespace docent::modules {

ScreenDesk::ScreenDesk(transport::Bus& bus, const std::filesystem::path& poll)
    : bus_{bus}, poll_{poll}, lamps_{bus.publisher(topics::kButtonLamps)}, says_{bus.publisher(topics::kSay)} {
  lamps_.publish({{to_message(bus_.now()), ""}, {}});
}

std::optional<Reason> ScreenDesk::take(const telepresence::ClientMessage& message, std::optional<MissionPhase> phase) {
  if (const auto* lamps = std::get_if<telepresence::LampsMessage>(&message)) {
    heard_ = bus_.now();
    light(lamps->lit);
    return Reason{};
  }
  if (const auto* answer = std::get_if<telepresence::AnswerMessage>(&message)) {
    const auto kept = poll_.add({answer->id, answer->question, answer->answer, answer->language}, bus_.now());
    fault_ = kept ? "" : kept.error().message;
    return kept ? Reason{} : ReasonWord::not_stored;
  }
  if (const auto* wanted = std::get_if<telepresence::HelpMessage>(&message)) return help(*wanted, phase);
  return std::nullopt;
}

Reason ScreenDesk::help(const telepresence::HelpMessage& message, std::optional<MissionPhase> phase) {
  const bool has_time =
      phase == MissionPhase::idle || phase == MissionPhase::waiting || phase == MissionPhase::charging;
  if (!has_time) return ReasonWord::busy;
  says_.publish({message.id, interaction::sentence(interaction::Sentence::help, message.language, Mood::neutral, 0),
                 message.language, to_text(Mood::happy)});
  return {};
}

void ScreenDesk::light(const std::vector<int>& lit) {
  if (lit == lit_) return;
  lit_ = lit;
  lamps_.publish({{to_message(bus_.now()), ""}, {lit.begin(), lit.end()}});
}

void ScreenDesk::look() {
  constexpr Duration kLampsSilent = std::chrono::seconds{12};  // the page says its lamps every 5 s
  if (bus_.now() - heard_ > kLampsSilent) light({});
}

}  // namespace docent::modules
