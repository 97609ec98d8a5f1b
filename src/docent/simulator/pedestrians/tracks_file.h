#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/simulator/pedestrians/track.h"

namespace docent::simulator {

/// The recorded people of a museum, in the world's frame: a line `recording NAME DURATION`, then its tracks, a line
/// each: `track START x y x y …`, metres and seconds, kTrackStep between two points.
[[nodiscard]] std::string to_text(std::span<const Recording> recordings);

/// Faults name file and line.
[[nodiscard]] Result<std::vector<Recording>> load_tracks(const std::filesystem::path& path);
/// From memory; `name` stands where the file's name would.
[[nodiscard]] Result<std::vector<Recording>> parse_tracks(std::string_view text, const std::string& name);

}  // namespace docent::simulator
