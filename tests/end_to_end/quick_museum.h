#pragma once

#include <filesystem>
#include <string>

namespace docent {

/// The same museum with little to say, in that folder: most of the time shall be spent driving.
/// @returns its folder
[[nodiscard]] std::string with_short_texts(const std::filesystem::path& museum, const std::filesystem::path& folder);

}  // namespace docent
