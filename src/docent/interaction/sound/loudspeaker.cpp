#include "docent/interaction/sound/loudspeaker.h"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace docent::interaction {
namespace {

constexpr Duration kRetry = std::chrono::seconds{5};        ///< after a card that could not be opened
constexpr std::int64_t kLongestWrite = 60LL * kSampleRate;  ///< [samples] written in one go; a longer pause is left out

}  // namespace

Loudspeaker::Loudspeaker(SoundOutput output, std::string place, const MixerParams& params, Time now)
    : output_{output}, place_{std::move(place)}, mixer_{params}, begin_{now} {
  if (is_there()) open(now);
}

std::string Loudspeaker::fault() const {
  if (!fault_.empty()) return fault_;
  return card_ ? card_->fault() : std::string{};
}

void Loudspeaker::open(Time now) {
  tried_ = now;
  if (output_ == SoundOutput::file) {
    auto file = WavWriter::create(place_);
    fault_ = file ? "" : file.error().message;
    if (file) file_ = std::move(*file);
    return;
  }
  card_.reset();
  auto card = SoundCard::open(place_, [this](std::span<std::int16_t> samples) {
    const std::scoped_lock lock{mutex_};
    mixer_.mix(samples);
  });
  fault_ = card ? "" : card.error().message;
  if (card) card_ = std::move(*card);
}

void Loudspeaker::speak(const SharedClip& line, double from_s) {
  const std::scoped_lock lock{mutex_};
  mixer_.speak(line, from_s);
}

void Loudspeaker::hush() {
  const std::scoped_lock lock{mutex_};
  mixer_.hush();
}

void Loudspeaker::honk(const SharedClip& horn) {
  const std::scoped_lock lock{mutex_};
  mixer_.honk(horn);
}

void Loudspeaker::play_music(const SharedClip& music, double from_s) {
  const std::scoped_lock lock{mutex_};
  mixer_.play_music(music, from_s);
}

void Loudspeaker::set_volume(double volume) {
  const std::scoped_lock lock{mutex_};
  mixer_.set_volume(volume);
}

void Loudspeaker::advance(Time now) {
  if (file_) write_until(now);
  if (output_ == SoundOutput::card && !fault().empty() && now - tried_ >= kRetry) open(now);
}

void Loudspeaker::write_until(Time now) {
  const auto due = static_cast<std::int64_t>(to_seconds(now - begin_) * kSampleRate);
  if (due - written_ > kLongestWrite) written_ = due - kLongestWrite;
  if (due <= written_) return;
  std::vector<std::int16_t> samples(static_cast<std::size_t>(due - written_));
  mixer_.mix(samples);
  written_ = due;
  auto written = file_->write(samples);
  if (written) return;
  fault_ = written.error().message;
  file_.reset();
}

}  // namespace docent::interaction
