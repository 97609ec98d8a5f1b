#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "docent/base/result.h"

namespace docent::interaction {

/// Plays on a sound card by ALSA, whose device `default` is PipeWire or PulseAudio where one of them runs: one channel
/// of sixteen bits at kSampleRate, a tenth of a second ahead of what is heard. A thread of its own asks for samples.
class SoundCard {
 public:
  /// Fills the span with what comes next; called by the card's thread.
  using Fill = std::function<void(std::span<std::int16_t>)>;
  /// `device`: a name of ALSA, for instance default, hw:1 or plughw:1. Error: "sound card 'DEVICE': why".
  [[nodiscard]] static Result<std::unique_ptr<SoundCard>> open(const std::string& device, Fill fill);
  SoundCard(const SoundCard&) = delete;
  SoundCard& operator=(const SoundCard&) = delete;
  ~SoundCard();  ///< ends the thread; what is not heard yet is dropped

  /// Why the card plays no longer, for instance because it was unplugged; empty: it plays.
  [[nodiscard]] std::string fault() const;

 private:
  struct Body;
  explicit SoundCard(std::unique_ptr<Body> body);
  std::unique_ptr<Body> body_;
};

}  // namespace docent::interaction
