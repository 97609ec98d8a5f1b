#include "docent/interaction/soundscape/soundscape.h"

#include <algorithm>
#include <utility>

#include "docent/interaction/sound/horn.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::interaction {

Soundscape::Soundscape(SoundscapeParts parts, SpeakerMemory memory, Time now)
    : parts_{std::move(parts)},
      speaker_{std::move(memory), now},
      loudspeaker_{parts_.output, parts_.place, parts_.mix, now},
      music_{parts_.music, parts_.audio, parts_.is_virtual_time} {}

SoundNews Soundscape::begin(double volume, Time now) {
  SoundNews news;
  if (!speaker_.present().id.empty()) news.lines.push_back(speaker_.present());
  if (loudspeaker_.is_there()) go_on_speaking(now);
  volume_ = volume;
  news.sound = news_of_sound();
  return news;
}

SoundNews Soundscape::step(double volume, Time now) {
  SoundNews news;
  volume_ = volume;
  at(now).set_volume(volume_);
  prepare_horn(now);
  if (speaker_.finish_if_over(now)) {
    save();
    news.lines.push_back(speaker_.present());
  }
  const bool wants_music =
      parts_.has_music && parts_.makes_sound && volume_ > 0.0 && ordered_music_.value_or(is_driving_);
  if (music_.play(wants_music, now)) at(now).play_music(music_.is_playing() ? music_.clip() : nullptr);
  news.sound = news_of_sound();
  return news;
}

SoundNews Soundscape::say(const Say& line, Time now) {
  switch (speaker_.judge(line)) {
    case Speaker::Verdict::under_way:
      if (speaker_.present().id == line.id) return {{speaker_.present()}, std::nullopt};
      return {};
    case Speaker::Verdict::finished:
      // It is ordered again by somebody who has not heard that it is over. The newest line stays the last one told.
      if (line.id == speaker_.present().id) return {{speaker_.present()}, std::nullopt};
      return {{{line.id, line.text, line.language, line.mood, false, now, 0.0, ""}, speaker_.present()}, std::nullopt};
    case Speaker::Verdict::fresh:
      break;
  }
  speaker_.expect(line);
  SpokenLine spoken{line.text, line.language, line.mood};
  if (!(volume_ > 0.0) || !voice_ || !voice_->can_render(spoken)) return begin_silently(line, now);
  const auto speech = voice_->render(line.id, std::move(spoken));
  return speech ? rendered(line.id, *speech, now) : SoundNews{};
}

SoundNews Soundscape::rendered(const std::string& id, const Result<RenderedSpeech>& speech, Time now) {
  speech_fault_ = speech ? "" : "no voice: " + speech.error().message;
  const std::optional<Say> expected = speaker_.expected();
  if (!expected || expected->id != id) return {};
  if (!speech) return begin_silently(*expected, now);
  recording_fault_ = speech->fault;
  SoundNews news = begin_line(speech->line.file, speech->line.duration_s, now);
  if (speech->clip) at(now).speak(speech->clip);
  return news;
}

SoundNews Soundscape::begin_silently(const Say& line, Time now) {
  at(now).hush();
  return begin_line("", speech_duration(line.text, line.language, line.mood), now);
}

SoundNews Soundscape::begin_line(const std::string& audio, double duration_s, Time now) {
  speaker_.begin(duration_s, audio, now);
  save();
  return {{speaker_.present()}, news_of_sound()};
}

void Soundscape::honk(Time now) {
  prepare_horn(now);
  if (horn_) at(now).honk(horn_);
}

Loudspeaker& Soundscape::at(Time now) {
  loudspeaker_.advance(now);
  return loudspeaker_;
}

void Soundscape::go_on_speaking(Time now) {
  const Speech& speech = speaker_.present();
  if (!speech.is_speaking || speech.audio.empty()) return;
  auto clip = read_clip(parts_.audio / speech.audio);
  if (!clip) return;  // the words remain
  at(now).speak(std::make_shared<const Clip>(std::move(*clip)), to_seconds(now - speech.start));
}

/// The horn's sound lies ready before it is needed: whoever hears of the horn may fetch it.
void Soundscape::prepare_horn(Time now) {
  constexpr Duration kRetry = std::chrono::seconds{5};  // after a file that could not be written
  if (!parts_.makes_sound || volume_ <= 0.0 || (horn_ && horn_fault_.empty())) return;
  if (horn_ && now - horn_tried_ < kRetry) return;
  horn_tried_ = now;
  Clip clip = horn_clip();
  const auto written = write_shared(shared_sound(clip), parts_.audio);
  horn_fault_ = written ? "" : "no horn: " + written.error().message;
  horn_ = std::make_shared<const Clip>(std::move(clip));
}

void Soundscape::save() {
  auto saved = save_checkpoint(parts_.checkpoint, speaker_.memory(), parts_.survives);
  disk_fault_ = saved ? "" : saved.error().message;
}

std::optional<PlayedSound> Soundscape::news_of_sound() {
  PlayedSound sound;
  sound.volume = volume_;
  if (music_.is_playing()) {
    // Pages play speech as it is rendered and music as its file holds it: its level is brought to that of the mix.
    const double duck_db = speaker_.present().is_speaking ? parts_.mix.duck_db : 0.0;
    const double gain_db = parts_.mix.music_db - duck_db - music_.loudness_db();
    sound.music = music_.file();
    sound.music_volume = std::min(1.0, volume_ * from_db(gain_db));
    sound.music_start = music_.start();
  }
  if (told_sound_ == sound) return std::nullopt;
  told_sound_ = sound;
  return sound;
}

std::string Soundscape::fault() const {
  for (const std::string* fault : {&speech_fault_, &recording_fault_, &disk_fault_, &horn_fault_})
    if (!fault->empty()) return *fault;
  if (!music_.fault().empty()) return "no music: " + music_.fault();
  const std::string silent = loudspeaker_.fault();
  return silent.empty() ? "" : "no loudspeaker: " + silent;
}

}  // namespace docent::interaction
