#include "docent/interaction/sound/clip.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace docent::interaction {
namespace {

constexpr double kFullScale = 32767.0;           ///< of sixteen bits
constexpr std::size_t kPart = kSampleRate / 20;  ///< [samples] 50 ms, a syllable
constexpr double kGate = 30.0;                   ///< [dB] below the loudest part: a pause

/// Mean square of the samples, each divided by `scale`.
template <class T>
double power(std::span<const T> samples, double scale) {
  if (samples.empty()) return 0.0;
  double sum = 0.0;
  for (const T sample : samples) {
    const double value = static_cast<double>(sample) / scale;
    sum += value * value;
  }
  return sum / static_cast<double>(samples.size());
}

}  // namespace

double duration_s(const Clip& clip) { return static_cast<double>(clip.size()) / kSampleRate; }

double from_db(double db) { return std::pow(10.0, db / 20.0); }
double to_db(double amplitude) { return amplitude > 0.0 ? std::max(kSilence, 20.0 * std::log10(amplitude)) : kSilence; }

double level_db(std::span<const float> samples) { return to_db(std::sqrt(power(samples, 1.0))); }
double level_db(std::span<const std::int16_t> samples) { return to_db(std::sqrt(power(samples, kFullScale))); }

double loudness_db(const Clip& clip) {
  std::vector<double> parts;  // [parts] mean squares
  for (std::size_t at = 0; at < clip.size(); at += kPart)
    parts.push_back(power(std::span<const float>{clip}.subspan(at, std::min(kPart, clip.size() - at)), 1.0));
  if (parts.empty()) return kSilence;
  const double gate = *std::max_element(parts.begin(), parts.end()) * std::pow(10.0, -kGate / 10.0);
  double sum = 0.0, count = 0.0;
  for (const double part : parts) {
    if (part < gate) continue;
    sum += part;
    count += 1.0;
  }
  return to_db(std::sqrt(sum / count));
}

Clip levelled(Clip clip, double loudness) {
  const double present = loudness_db(clip);
  if (present <= kSilence) return clip;
  const auto gain = static_cast<float>(from_db(loudness - present));
  for (float& sample : clip) sample *= gain;
  return clip;
}

std::int16_t to_pcm(double sample) {
  return static_cast<std::int16_t>(std::lround(kFullScale * std::clamp(sample, -1.0, 1.0)));
}

}  // namespace docent::interaction
