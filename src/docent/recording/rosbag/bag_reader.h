#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/recording/rosbag/rosbag2_database.h"

namespace docent::recording {

/// Reads a recording of ROS as ROS 2 has it: an MCAP file (zstd, LZ4; messages as CDR or as ROS 1 wrote them), a
/// rosbag2 database (also one whose messages are packed one by one), either of them packed as a whole (.zstd), a folder
/// of such parts, or a bag of ROS 1; until `handler` returns false. Of parts that follow one another one that is torn
/// or empty, or a file that is cut, costs what it lacks. Of ROS 1 messages that do not matter here come without data.
/// @param notes  what was left out, and why
/// Error: "FILE: …": unreadable, or nothing that is a recording.
[[nodiscard]] Result<void> read_bag(const std::filesystem::path& path,
                                    const std::function<bool(const Rosbag2Message&)>& handler,
                                    std::vector<std::string>& notes);

/// Whether read_bag is meant for it, by content and name.
[[nodiscard]] bool is_bag(const std::filesystem::path& path);

}  // namespace docent::recording
