#include "docent/interaction/sound/horn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent::interaction {
namespace {

constexpr std::array<double, 2> kTones{349.23, 440.00};  ///< [Hz] F4 and A4, the major third of a car's horn
constexpr int kHarmonics = 6;                            ///< of each tone, the n-th with amplitude 1/n
constexpr double kBlast = 0.22;                          ///< [s]
constexpr double kGap = 0.10;                            ///< [s] between the two blasts
constexpr double kSwell = 0.012;                         ///< [s] so that no click is heard
constexpr double kFade = 0.05;                           ///< [s]
constexpr double kHornLevel = 0.5;  ///< of full scale: the horn is heard beside speech and startles nobody

/// 0..1 at `t` [s] after a blast begins.
double envelope(double t) {
  if (t < 0.0 || t > kBlast) return 0.0;
  return std::min({1.0, t / kSwell, (kBlast - t) / kFade});
}

/// Tones and harmonics at time `t` [s], within -1..1.
double tone(double t) {
  double sum = 0.0, most = 0.0;
  for (const double pitch : kTones) {
    for (int n = 1; n <= kHarmonics; ++n) {
      sum += std::sin(2.0 * std::numbers::pi * pitch * n * t) / n;
      most += 1.0 / n;
    }
  }
  return sum / most;
}

}  // namespace

Clip horn_clip() {
  Clip clip(static_cast<std::size_t>((2.0 * kBlast + kGap) * kSampleRate));
  for (std::size_t i = 0; i < clip.size(); ++i) {
    const double t = static_cast<double>(i) / kSampleRate;
    clip[i] = static_cast<float>(kHornLevel * (envelope(t) + envelope(t - kBlast - kGap)) * tone(t));
  }
  return clip;
}

SharedSound horn_sound() { return shared_sound(horn_clip()); }

}  // namespace docent::interaction
