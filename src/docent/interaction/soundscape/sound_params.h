#pragma once

#include <string>

#include "docent/base/result.h"
#include "docent/interaction/sound/loudspeaker.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// Section `sound`: speech, horn and music.
struct SoundParams {
  std::string program = "espeak-ng";  ///< renders the speech; empty: recordings, and the words alone
  double timeout_s = 15.0;            ///< [s] > 0 for one line; espeak-ng needs a hundredth of what saying it takes
  bool ahead = true;                  ///< renders in idle time all that the robot can say in this museum
  std::string output = "none";        ///< where the robot is heard: card, file, or none; the pages play it in any case
  std::string device = "default";     ///< ALSA's name of the card, for instance default or plughw:1
  std::string file;                   ///< where output file goes; empty: sound.wav in the state's folder
  bool music = true;                  ///< plays music while it drives, or when docent/music orders it
  MixerParams mix;                    ///< how loud what is
  template <class V>
  void visit(V& v) {
    v("program", program);
    v("timeout_s", timeout_s);
    v("ahead", ahead);
    v("output", output);
    v("device", device);
    v("file", file);
    v("music", music);
    v("mix", mix);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(timeout_s > 0.0)) return fail("sound.timeout_s must be > 0");
    if (!parse<SoundOutput>(output)) return fail("sound.output must be none, card or file");
    if (auto valid = mix.validate(); !valid) return fail("sound." + valid.error().message);
    return {};
  }
};

}  // namespace docent::interaction
