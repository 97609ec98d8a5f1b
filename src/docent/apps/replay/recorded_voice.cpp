#include "docent/apps/replay/recorded_voice.h"

#include <algorithm>

#include "docent/interaction/speech/spoken_text.h"
#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::apps::replay_command {

void RecordedLines::add(const recording::RecordedMessage& message) {
  if (const auto* say = message.as(topics::kSay)) {
    // Orders are repeated until they are seen; the first counts.
    open_.try_emplace(say->id, Open{{say->language, say->text}, message.time, std::nullopt});
  } else if (const auto* state = message.as(topics::kSpeechState)) {
    const auto found = open_.find(state->id);
    if (found == open_.end()) return;
    Open& open = found->second;
    const bool is_speaking = parse<SpeechStatus>(state->state) == SpeechStatus::speaking;
    if (is_speaking && !open.begun) open.begun = message.time;
    if (is_speaking || !open.begun) return;
    timings_[open.line].push_back({*open.begun - open.ordered, message.time - *open.begun});
    // Said once: later states of the same line are repetitions.
    open.begun.reset();
    open.line.second.clear();
  }
}

RecordedLines::Timing RecordedLines::timing_of(const docent_msgs::Say& say) {
  const Line line{say.language, say.text};
  const auto found = timings_.find(line);
  if (found == timings_.end())
    return {Duration{}, seconds(interaction::speech_duration(interaction::spoken_text(say.text), say.language,
                                                             parse<Mood>(say.mood).value_or(Mood::neutral)))};
  const std::size_t time = std::min(said_[line]++, found->second.size() - 1);
  return found->second[time];
}

RecordedVoice::RecordedVoice(transport::Bus& bus, RecordedLines lines)
    : bus_{bus}, lines_{std::move(lines)}, speaker_{{}, bus.now()}, state_{bus.publisher(topics::kSpeechState)} {
  bus_.subscribe<docent_msgs::Say>(topics::kSay, [this](const auto& say) { on_say(say); });
}

void RecordedVoice::on_say(const docent_msgs::Say& message) {
  const interaction::Say say{message.id, interaction::spoken_text(message.text), message.language,
                             parse<Mood>(message.mood).value_or(Mood::neutral)};
  switch (speaker_.judge(say)) {
    case interaction::Speaker::Verdict::under_way:
      if (speaker_.present().id == say.id) publish(speaker_.present());
      return;
    case interaction::Speaker::Verdict::finished:
      publish({say.id, say.text, say.language, say.mood, false, bus_.now(), 0.0, ""});
      if (speaker_.present().id != say.id) publish(speaker_.present());
      return;
    case interaction::Speaker::Verdict::fresh:
      break;
  }
  speaker_.expect(say);
  const RecordedLines::Timing timing = lines_.timing_of(message);
  bus_.after(timing.until_begin, [this, id = say.id, timing] {
    if (!speaker_.expected() || speaker_.expected()->id != id) return;
    speaker_.begin(to_seconds(timing.speaking), "", bus_.now());
    publish(speaker_.present());
    bus_.after(timing.speaking, [this, id] {
      if (speaker_.present().id == id && speaker_.finish_if_over(bus_.now())) publish(speaker_.present());
    });
  });
}

void RecordedVoice::publish(const interaction::Speech& speech) {
  state_.publish({{to_message(bus_.now()), ""},
                  speech.id,
                  to_text(speech.is_speaking ? SpeechStatus::speaking : SpeechStatus::done),
                  speech.text,
                  speech.language,
                  to_message(speech.start),
                  speech.duration_s,
                  speech.audio});
}

}  // namespace docent::apps::replay_command
