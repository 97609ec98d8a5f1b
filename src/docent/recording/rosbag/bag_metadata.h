#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace docent::recording {

/// The parts of a rosbag2 folder in the order of its metadata.yaml, or, where there is none, of their names' numbers.
/// @param notes  what the metadata names and is not there, what is there and is not named, metadata that cannot be read
[[nodiscard]] std::vector<std::filesystem::path> parts_of_bag(const std::filesystem::path& folder,
                                                              std::vector<std::string>& notes);

/// Whether a file's name is that of a part of a rosbag2 recording: .mcap, .db3, and these packed as a whole by zstd.
[[nodiscard]] bool is_part_of_bag(const std::filesystem::path& file);

}  // namespace docent::recording
