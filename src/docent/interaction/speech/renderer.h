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
  double volume = 1.0;  ///< 0..1; in steps of a tenth
};

struct RenderedLine {
  std::string file;         ///< its name in the folder, HASH.wav
  double duration_s = 0.0;  ///< from the WAV header
};

/// HASH.wav: the same line has the same name everywhere.
[[nodiscard]] std::string audio_file_name(const SpokenLine& line);

/// Length [s] of a WAV file of PCM samples. Error: "FILE: why".
[[nodiscard]] Result<double> wav_duration(const std::filesystem::path& path);

/// Speaks into `folder`/HASH.wav with espeak-ng, a process of its own without a shell; what is there already is not
/// made again. The file appears whole or not at all. Error when the program is missing, fails, takes longer than
/// `timeout_s` or `stop` becomes true; the process is gone when this returns.
[[nodiscard]] Result<RenderedLine> render_speech(const SpokenLine& line, const std::filesystem::path& folder,
                                                 const std::string& program, double timeout_s,
                                                 const std::atomic<bool>& stop);

}  // namespace docent::interaction
