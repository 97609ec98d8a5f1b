#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "docent/base/result.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

struct SpokenLine {
  std::string text;  ///< plain, UTF-8
  std::string language;
  Mood mood = Mood::neutral;
};

struct RenderedLine {
  std::string file;         ///< its name in the folder, HASH.wav; of a recording also HASH.ogg or HASH.flac
  double duration_s = 0.0;  ///< of what is heard
};

/// HASH.wav: the same line has the same name everywhere.
[[nodiscard]] std::string audio_file_name(const SpokenLine& line);

/// Speaks into `folder`/HASH.wav with espeak-ng, a process of its own without a shell; what is there already is not
/// made again. The file appears whole or not at all. Error when the program is missing, fails, takes longer than
/// `timeout_s` or `stop` becomes true; the process is gone when this returns.
[[nodiscard]] Result<RenderedLine> render_speech(const SpokenLine& line, const std::filesystem::path& folder,
                                                 const std::string& program, double timeout_s,
                                                 const std::atomic<bool>& stop);

/// Copies a recorded line into `folder` under the name of its content; what is there already is not copied again.
/// Error: "FILE: why", also for what is no sound file or larger than 32 MB.
[[nodiscard]] Result<RenderedLine> take_recording(const std::filesystem::path& recording,
                                                  const std::filesystem::path& folder);

}  // namespace docent::interaction
