#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace docent::interaction {

inline constexpr int kSampleRate = 44'100;  ///< [Hz] of everything that is mixed

/// Sound of one channel: samples at kSampleRate, full scale is -1..1.
using Clip = std::vector<float>;
/// A clip that several may play at once.
using SharedClip = std::shared_ptr<const Clip>;

[[nodiscard]] double duration_s(const Clip& clip);

/// Amplitude ratio of so many decibels, and back. `to_db` of 0 is kSilence.
[[nodiscard]] double from_db(double db);
[[nodiscard]] double to_db(double amplitude);
inline constexpr double kSilence = -120.0;  ///< [dB]

/// Root mean square of the samples [dB of full scale]: 0 for a square wave at full scale, kSilence for silence. O(n).
[[nodiscard]] double level_db(std::span<const float> samples);
[[nodiscard]] double level_db(std::span<const std::int16_t> samples);

/// Level of those parts that sound [dB of full scale]: pauses do not count. Parts of 50 ms are left out where they lie
/// more than 30 dB below the loudest one. O(n).
[[nodiscard]] double loudness_db(const Clip& clip);

/// The clip as loud as that (`loudness_db`); silence remains silence. A quiet recording and a loud voice come out
/// alike.
[[nodiscard]] Clip levelled(Clip clip, double loudness);

/// Sixteen bits of a sample; what exceeds full scale is cut.
[[nodiscard]] std::int16_t to_pcm(double sample);

}  // namespace docent::interaction
