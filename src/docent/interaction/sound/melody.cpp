#include "docent/interaction/sound/melody.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace docent::interaction {
namespace {

constexpr double kBeat = 60.0 / 112.0;  ///< [s] 112 beats a minute: a brisk walk
constexpr double kMelodyLevel = 0.5;    ///< of full scale
constexpr int kRest = 0;

/// `pitch`: MIDI number, 60 is C4, 69 is A4 (440 Hz).
struct Note {
  int pitch;
  double beats;
};

// Eight bars of four beats in C major.
constexpr std::array kVoice{
    Note{64, 1.0}, Note{67, 0.5}, Note{69, 0.5}, Note{72, 1.0},    Note{69, 1.0},                 // C
    Note{67, 0.5}, Note{69, 0.5}, Note{67, 0.5}, Note{64, 0.5},    Note{62, 2.0},                 // G
    Note{65, 1.0}, Note{69, 0.5}, Note{72, 0.5}, Note{74, 1.0},    Note{72, 1.0},                 // F
    Note{71, 0.5}, Note{72, 0.5}, Note{74, 0.5}, Note{71, 0.5},    Note{67, 2.0},                 // G
    Note{76, 1.0}, Note{74, 0.5}, Note{72, 0.5}, Note{69, 1.0},    Note{72, 1.0},                 // Am
    Note{69, 0.5}, Note{67, 0.5}, Note{65, 0.5}, Note{69, 0.5},    Note{67, 2.0},                 // F
    Note{64, 0.5}, Note{65, 0.5}, Note{67, 1.0}, Note{62, 0.5},    Note{65, 0.5}, Note{71, 1.0},  // G
    Note{72, 1.0}, Note{67, 1.0}, Note{60, 1.0}, Note{kRest, 1.0},                                // C
};
constexpr std::array kBass{
    Note{48, 2.0}, Note{55, 2.0}, Note{43, 2.0}, Note{50, 2.0}, Note{53, 2.0}, Note{48, 2.0},
    Note{43, 2.0}, Note{47, 2.0}, Note{45, 2.0}, Note{52, 2.0}, Note{53, 2.0}, Note{48, 2.0},
    Note{43, 2.0}, Note{50, 2.0}, Note{48, 2.0}, Note{43, 2.0},
};

/// How a string sounds that was plucked: harmonics, each of which fades, the higher the faster.
struct Instrument {
  double amplitude;
  int harmonics;  ///< the n-th with amplitude 1/n²
  double half_s;  ///< [s] the first harmonic sinks to a half of it, the n-th n times as fast
};
constexpr Instrument kPlucked{1.0, 5, 0.25};
constexpr Instrument kLow{0.7, 3, 0.45};

constexpr double kBeats = 32.0;  ///< of the whole tune
constexpr double beats_of(std::span<const Note> notes) {
  double beats = 0.0;
  for (const Note& note : notes) beats += note.beats;
  return beats;
}
static_assert(beats_of(kVoice) == kBeats && beats_of(kBass) == kBeats);

double frequency(int pitch) { return 440.0 * std::exp2((pitch - 69) / 12.0); }

/// Adds the note from sample `begin` on; what rings on after the end goes to the beginning, as it does in a loop.
void pluck(Clip& clip, std::size_t begin, const Note& note, const Instrument& instrument) {
  constexpr double kAttack = 0.006;  // [s] so that no click is heard
  constexpr double kRing = 0.25;     // [s] after the note's time
  constexpr double kRelease = 0.1;   // [s] at the end of that
  const double length = note.beats * kBeat + kRing;
  const double turn = 2.0 * std::numbers::pi * frequency(note.pitch);
  for (std::size_t i = 0; i < static_cast<std::size_t>(length * kSampleRate); ++i) {
    const double t = static_cast<double>(i) / kSampleRate;
    double value = 0.0;
    for (int n = 1; n <= instrument.harmonics; ++n)
      value += std::sin(turn * n * t) * std::exp2(-t * n / instrument.half_s) / (n * n);
    value *= instrument.amplitude * std::min({1.0, t / kAttack, (length - t) / kRelease});
    clip[(begin + i) % clip.size()] += static_cast<float>(value);
  }
}

void play(Clip& clip, std::span<const Note> notes, const Instrument& instrument) {
  double beat = 0.0;
  for (const Note& note : notes) {
    const auto begin = static_cast<std::size_t>(beat * kBeat * kSampleRate);
    if (note.pitch != kRest) pluck(clip, begin, note, instrument);
    beat += note.beats;
  }
}

}  // namespace

Clip melody_clip() {
  Clip clip(static_cast<std::size_t>(kBeats * kBeat * kSampleRate));
  play(clip, kVoice, kPlucked);
  play(clip, kBass, kLow);
  float most = 0.0F;
  for (const float sample : clip) most = std::max(most, std::abs(sample));
  for (float& sample : clip) sample *= static_cast<float>(kMelodyLevel) / most;
  return clip;
}

}  // namespace docent::interaction
