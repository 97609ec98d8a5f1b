#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"

namespace docent::recording {

/// A message of a rosbag2 recording. Valid during the call that hands it over.
struct Rosbag2Message {
  const std::string& topic;  ///< "/scan"
  const std::string& type;   ///< "sensor_msgs/msg/LaserScan"
  Time time;
  std::span<const std::uint8_t> data;  ///< CDR
};

/// Reads the SQLite file (.db3) of a rosbag2 folder in the order of its times until `handler` returns false. Messages
/// that are packed one by one (zstd) are unpacked. Of a file that is cut or damaged every message that is whole is
/// read, in the order of the table, and a note says how many. Error: "FILE: …": unreadable, or no such database.
[[nodiscard]] Result<void> read_rosbag2_database(const std::filesystem::path& path,
                                                 const std::function<bool(const Rosbag2Message&)>& handler,
                                                 std::vector<std::string>& notes);

}  // namespace docent::recording
