#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::apps::calibrate_camera_command {

/// A picture to look for a board in.
struct GreyImage {
  std::string name;  ///< of its file, or its topic and time
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> grey{};  ///< [rows * columns] from the top
  std::string fault{};               ///< why it cannot be read; empty: it was
};

/// Pictures of a folder (PNG, PGM, JPEG; by name), or of one topic of a recording (MCAP): at most `a_second` of them.
/// Error: nothing there, or a recording that cannot be read, or has no or several topics of pictures and none was
/// named.
[[nodiscard]] Result<void> read_pictures(const std::filesystem::path& from, const std::string& topic, double a_second,
                                         const std::function<void(GreyImage)>& take);

}  // namespace docent::apps::calibrate_camera_command
