#include "docent/interaction/sound/mixer.h"

#include <algorithm>
#include <cmath>

namespace docent::interaction {
namespace {

constexpr double kBreakOff = 0.01;     ///< [s] in which a line is broken off: no click is heard, and no word
constexpr double kVolumeGlide = 0.1;   ///< [s] from silence to full volume
constexpr std::size_t kMostClips = 8;  ///< clips of one kind; older ones are on their way out

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

/// What a gain changes a sample, so that it goes all the way in `duration_s`.
double step_of(double duration_s) { return 1.0 / (duration_s * kSampleRate); }

}  // namespace

Result<void> MixerParams::validate() const {
  if (!is_within(speech_db, -40.0, 0.0)) return fail("mix.speech_db must be -40 to 0");
  if (!is_within(horn_db, -40.0, 0.0)) return fail("mix.horn_db must be -40 to 0");
  if (!is_within(music_db, -60.0, 0.0)) return fail("mix.music_db must be -60 to 0");
  if (!is_within(duck_db, 0.0, 60.0)) return fail("mix.duck_db must be 0 to 60");
  if (!(fade_s > 0.0)) return fail("mix.fade_s must be > 0");
  if (!(duck_s > 0.0)) return fail("mix.duck_s must be > 0");
  if (!(release_s > 0.0)) return fail("mix.release_s must be > 0");
  if (!is_within(limiter_knee, 0.1, 1.0)) return fail("mix.limiter_knee must be 0.1 to 1");
  return {};
}

double Mixer::Ramp::next() {
  value += std::clamp(target - value, -step, step);
  return value;
}

bool Mixer::Playing::is_over() const { return at >= clip->size() || (gain.target == 0.0 && gain.value == 0.0); }

double Mixer::Playing::next() {
  if (is_over()) return 0.0;
  const double value = level * gain.next() * static_cast<double>((*clip)[at]);
  ++at;
  if (is_looped && at == clip->size()) at = 0;
  return value;
}

Mixer::Mixer(const MixerParams& params)
    : params_{params}, duck_{1.0, 1.0, 1.0}, volume_{1.0, 1.0, step_of(kVolumeGlide)} {
  lines_.reserve(kMostClips);
  music_.reserve(kMostClips);
}

Mixer::Playing Mixer::playing(const SharedClip& clip, double loudness, double from_s) const {
  const auto from = static_cast<std::size_t>(std::max(0.0, from_s) * kSampleRate);
  const double present = loudness_db(*clip);
  return {clip, from, false, {1.0, 1.0, step_of(kBreakOff)}, present > kSilence ? from_db(loudness - present) : 0.0};
}

void Mixer::speak(const SharedClip& line, double from_s) {
  hush();
  if (lines_.size() == kMostClips) lines_.erase(lines_.begin());
  lines_.push_back(playing(line, params_.speech_db, from_s));
}

void Mixer::hush() {
  for (Playing& line : lines_) line.gain.target = 0.0;
}

void Mixer::honk(const SharedClip& horn) {
  if (horns_.empty()) horns_.push_back(playing(horn, params_.horn_db, 0.0));
}

void Mixer::play_music(const SharedClip& music, double from_s) {
  if (music && !music_.empty() && music_.back().clip == music) {  // it goes on where it is
    music_.back().gain.target = 1.0;
    return;
  }
  for (Playing& before : music_) before.gain.target = 0.0;
  if (!music || music->empty()) return;
  if (music_.size() == kMostClips) music_.erase(music_.begin());
  Playing begun = playing(music, params_.music_db, std::fmod(std::max(0.0, from_s), duration_s(*music)));
  begun.at %= music->size();
  begun.is_looped = true;
  begun.gain = {0.0, 1.0, step_of(params_.fade_s)};
  music_.push_back(std::move(begun));
}

void Mixer::set_volume(double volume) { volume_.target = std::clamp(volume, 0.0, 1.0); }

double Mixer::sum_of(std::vector<Playing>& several) {
  double sum = 0.0;
  for (Playing& one : several) sum += one.next();
  return sum;
}

double Mixer::limited(double value) const {
  const double knee = params_.limiter_knee, room = 1.0 - knee;
  const double size = std::abs(value);
  if (size <= knee) return value;
  return std::copysign(room > 0.0 ? knee + room * std::tanh((size - knee) / room) : knee, value);
}

void Mixer::mix(std::span<std::int16_t> out) {
  const double ducked = from_db(-params_.duck_db);
  for (std::int16_t& sample : out) {
    const bool is_speaking = !lines_.empty() && lines_.back().gain.target > 0.0 && !lines_.back().is_over();
    duck_.target = is_speaking ? ducked : 1.0;
    duck_.step = step_of(is_speaking ? params_.duck_s : params_.release_s);
    const double sum = sum_of(lines_) + sum_of(horns_) + duck_.next() * sum_of(music_);
    sample = to_pcm(limited(volume_.next() * sum));
  }
  const auto is_over = [](const Playing& one) { return one.is_over(); };
  std::erase_if(lines_, is_over);
  std::erase_if(horns_, is_over);
  std::erase_if(music_, is_over);
}

}  // namespace docent::interaction
