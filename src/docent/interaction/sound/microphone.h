#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/interaction/sound/clip.h"

namespace docent::interaction {

/// Where sound comes in: a sound card, a file, what a test feeds.
class Microphone {
 public:
  Microphone() = default;
  Microphone(const Microphone&) = delete;
  Microphone& operator=(const Microphone&) = delete;
  virtual ~Microphone() = default;

  /// Somebody is going to speak: what was heard before is dropped.
  [[nodiscard]] virtual Result<void> begin(Time now) = 0;
  /// What has come since, at kSampleRate; never waits. Error: why nothing comes any more.
  [[nodiscard]] virtual Result<Clip> read(Time now) = 0;
  /// Nobody speaks any more: the device is free for others.
  virtual void end() {}
};

/// Of a sound card by ALSA: one channel of sixteen bits. It is open from `begin` to `end`: while nobody
/// has pressed the button, nothing is recorded anywhere. Errors: "microphone 'DEVICE': why".
[[nodiscard]] std::unique_ptr<Microphone> open_microphone(const std::string& device);

/// A sound file, heard from its beginning each time somebody is going to speak, as fast as it would be spoken; then
/// silence.
[[nodiscard]] std::unique_ptr<Microphone> file_microphone(const std::filesystem::path& path);

}  // namespace docent::interaction
