#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "docent/base/result.h"
#include "docent/interaction/sound/clip.h"

namespace docent::interaction {

/// How the names of sound files end that a museum may bring: WAV, Ogg (Vorbis or Opus), FLAC.
[[nodiscard]] bool is_sound_file(const std::filesystem::path& path);

/// Length [s] of a sound file, by what it holds and not by what its header promises. Error: "FILE: why"; also for more
/// than half an hour.
[[nodiscard]] Result<double> sound_duration(const std::filesystem::path& path);

/// All of a sound file, its channels averaged, at kSampleRate. Error: as above.
[[nodiscard]] Result<Clip> read_clip(const std::filesystem::path& path);

/// A sound that everybody may fetch: its name in the folder of what is heard, HASH.wav, is that of its content.
struct SharedSound {
  std::string file;
  std::string content;      ///< a WAV file: mono, 16 bits a sample, kSampleRate
  double duration_s = 0.0;  ///< from the first sample to the last
};
[[nodiscard]] SharedSound shared_sound(const Clip& clip);

/// Writes the sound into `folder` unless it lies there already. Error: "FILE: why".
[[nodiscard]] Result<void> write_shared(const SharedSound& sound, const std::filesystem::path& folder);

/// The name of a file by its content: HASH and its own ending in small letters.
[[nodiscard]] std::string shared_name(std::string_view content, const std::filesystem::path& file);

/// A WAV file that grows: mono, 16 bits a sample, kSampleRate. Whole when this goes out of scope; a process that dies
/// leaves what was written, under a header that is a moment old.
class WavWriter {
 public:
  [[nodiscard]] static Result<WavWriter> create(const std::filesystem::path& path);
  [[nodiscard]] Result<void> write(std::span<const std::int16_t> samples);

 private:
  struct Close {
    void operator()(void* file) const;
  };
  explicit WavWriter(std::string name, void* file) : name_{std::move(name)}, file_{file} {}
  std::string name_;
  std::unique_ptr<void, Close> file_;
};

}  // namespace docent::interaction
