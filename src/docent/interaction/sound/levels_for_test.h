#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "docent/interaction/sound/clip.h"

// For tests: what can be measured in a sound.

namespace docent::interaction {

/// A sine of so many Hz and this level [dB of full scale, root mean square].
inline Clip sine(double frequency, double level, double duration_s) {
  Clip clip(static_cast<std::size_t>(duration_s * kSampleRate));
  for (std::size_t i = 0; i < clip.size(); ++i) {
    const double t = static_cast<double>(i) / kSampleRate;
    clip[i] =
        static_cast<float>(std::numbers::sqrt2 * from_db(level) * std::sin(2.0 * std::numbers::pi * frequency * t));
  }
  return clip;
}

/// The part from `begin_s` to `end_s` [s].
inline std::span<const std::int16_t> part(const std::vector<std::int16_t>& samples, double begin_s, double end_s) {
  const auto begin = static_cast<std::size_t>(begin_s * kSampleRate);
  return std::span{samples}.subspan(begin, static_cast<std::size_t>(end_s * kSampleRate) - begin);
}

/// Goertzel's filter: the level [dB of full scale, root mean square] of the sine of so many Hz in the samples.
inline double goertzel_db(std::span<const std::int16_t> samples, double frequency) {
  const double turn = 2.0 * std::numbers::pi * frequency / kSampleRate;
  const double coefficient = 2.0 * std::cos(turn);
  double last = 0.0, before = 0.0;
  for (const std::int16_t sample : samples) {
    const double next = static_cast<double>(sample) / 32767.0 + coefficient * last - before;
    before = last;
    last = next;
  }
  const double power = last * last + before * before - coefficient * last * before;
  return to_db(std::numbers::sqrt2 * std::sqrt(std::max(0.0, power)) / static_cast<double>(samples.size()));
}

}  // namespace docent::interaction
