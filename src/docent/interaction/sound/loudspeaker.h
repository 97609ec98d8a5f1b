#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/interaction/sound/clip.h"
#include "docent/interaction/sound/mixer.h"
#include "docent/interaction/sound/sound_card.h"
#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction {

/// Where the mix goes: nowhere, to a sound card, into a file.
enum class SoundOutput { none, card, file };
[[nodiscard]] constexpr auto words_of(SoundOutput) { return std::array{"none", "card", "file"}; }

/// The loudspeaker of the robot itself: a mixer, and where its mix goes. A card that is missing or goes away makes it
/// silent and is sought again every five seconds; nothing else depends on it. Mixing for a card happens on the card's
/// thread, for a file in `advance`; the owner calls everything from one thread.
class Loudspeaker {
 public:
  /// `place`: the card's device or the file's path. `now`: when the file's first sample sounds.
  Loudspeaker(SoundOutput output, std::string place, const MixerParams& params, Time now);
  Loudspeaker(const Loudspeaker&) = delete;
  Loudspeaker& operator=(const Loudspeaker&) = delete;
  ~Loudspeaker() = default;  ///< what sounds is broken off

  /// False: nothing that is played here is heard, so clips need not be read.
  [[nodiscard]] bool is_there() const { return output_ != SoundOutput::none; }
  /// Why it is silent although it is there; empty: it is not.
  [[nodiscard]] std::string fault() const;

  // As Mixer does.
  void speak(const SharedClip& line, double from_s = 0.0);
  void hush();
  void honk(const SharedClip& horn);
  void play_music(const SharedClip& music, double from_s = 0.0);
  void set_volume(double volume);

  /// Several times a second: writes the mix until `now` into the file; seeks a card that is missing.
  void advance(Time now);

 private:
  void open(Time now);
  void write_until(Time now);

  SoundOutput output_;
  std::string place_;
  mutable std::mutex mutex_;  ///< of `mixer_`, which the card's thread asks
  Mixer mixer_;
  std::string fault_;
  Time tried_;
  Time begin_;                ///< of the file
  std::int64_t written_ = 0;  ///< [samples] of the file
  std::optional<WavWriter> file_;
  std::unique_ptr<SoundCard> card_;  ///< last: its thread ends first
};

}  // namespace docent::interaction
