#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/interaction/sound/clip.h"

namespace docent::interaction {

/// Section `sound.mix`: how loud what is. Levels are root mean squares of what sounds (`loudness_db`), in dB of full
/// scale, at volume 1.
struct MixerParams {
  double speech_db = -22.0;   ///< [dB] -40..0; peaks of espeak-ng's speech lie 19 dB above its level, so they just fit
  double horn_db = -14.0;     ///< [dB] -40..0; 8 dB over speech: the horn is short, and must be heard over it
  double music_db = -34.0;    ///< [dB] -60..0; 12 dB below speech: music that one hears and talks over
  double duck_db = 12.0;      ///< [dB] 0..60; music sinks by it under speech, to 24 dB below: WCAG 1.4.7 asks for 20
  double fade_s = 1.5;        ///< [s] > 0; music comes and goes softly, within the first metre of a drive
  double duck_s = 0.2;        ///< [s] > 0; music sinks within the first syllable
  double release_s = 1.0;     ///< [s] > 0; and comes back slowly, so that pauses between sentences do not pump
  double limiter_knee = 0.7;  ///< 0.1..1 of full scale; what is louder is bent, and never reaches full scale
  template <class V>
  void visit(V& v) {
    v("speech_db", speech_db);
    v("horn_db", horn_db);
    v("music_db", music_db);
    v("duck_db", duck_db);
    v("fade_s", fade_s);
    v("duck_s", duck_s);
    v("release_s", release_s);
    v("limiter_knee", limiter_knee);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Mixes a line of speech, the horn and music to one channel of sixteen bits. Lines, horn and music come in as clips of
/// any level and go out at those of the parameters; music sinks under speech. Speech and horn are not changed by one
/// another. The sum goes through a soft limiter, so it never clips. Deterministic: the same calls between the same
/// samples give the same samples. Not for several threads at once.
class Mixer {
 public:
  explicit Mixer(const MixerParams& params);

  /// Plays a line from so many seconds on; the line before is broken off within a hundredth of a second.
  void speak(const SharedClip& line, double from_s = 0.0);
  void hush();
  /// Sounds the horn, over whatever is said. While it sounds it is not begun again.
  void honk(const SharedClip& horn);
  /// Plays music round and round, from so many seconds on; null: it fades out.
  void play_music(const SharedClip& music, double from_s = 0.0);
  /// 0..1, an amplitude ratio of the sum. It is reached within a tenth of a second.
  void set_volume(double volume);

  /// Fills `out` with what comes next. O(samples), no allocation.
  void mix(std::span<std::int16_t> out);

 private:
  /// A gain on its way to its target, by at most `step` a sample.
  struct Ramp {
    double value = 0.0;
    double target = 0.0;
    double step = 1.0;
    double next();
  };
  struct Playing {
    SharedClip clip;
    std::size_t at = 0;
    bool is_looped = false;
    Ramp gain;           ///< 0..1
    double level = 0.0;  ///< what brings the clip to its level
    [[nodiscard]] bool is_over() const;
    double next();
  };
  [[nodiscard]] Playing playing(const SharedClip& clip, double loudness, double from_s) const;
  static double sum_of(std::vector<Playing>& several);
  [[nodiscard]] double limited(double value) const;

  MixerParams params_;
  std::vector<Playing> lines_;  ///< the last one is said, those before it are broken off
  std::vector<Playing> horns_;  ///< at most one
  std::vector<Playing> music_;  ///< the last one plays, unless it fades out as those before it do
  Ramp duck_;
  Ramp volume_;
};

}  // namespace docent::interaction
