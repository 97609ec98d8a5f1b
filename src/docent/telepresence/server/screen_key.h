#pragma once

#include <filesystem>
#include <string>

#include "docent/base/result.h"

namespace docent::telepresence {

/// The key by which the robot's own screen is known: 32 hexadecimal digits in a file that its owner and nobody else
/// reads. Made by chance where there is none, or where something else stands in the file. Error: "FILE: why".
[[nodiscard]] Result<std::string> screen_key(const std::filesystem::path& file);

}  // namespace docent::telepresence
