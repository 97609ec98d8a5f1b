#pragma once

#include <filesystem>
#include <string>

#include "docent/base/result.h"

namespace docent::interaction {

/// The sound of the horn as a WAV file: two short blasts of two tones.
struct HornSound {
  std::string file;         ///< its name in the folder of rendered speech, HASH.wav: of its content
  std::string content;      ///< mono, 16 bits a sample
  double duration_s = 0.0;  ///< from the first sample to the last
};

/// Every process makes the same sound and so knows its name. `volume`: 0..1, in steps of a tenth.
[[nodiscard]] HornSound horn_sound(double volume);

/// Writes the sound into `folder` unless it lies there already. Error: "FILE: why".
[[nodiscard]] Result<void> write_horn_sound(const HornSound& horn, const std::filesystem::path& folder);

}  // namespace docent::interaction
