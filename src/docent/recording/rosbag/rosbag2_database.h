#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

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
/// that are packed one by one (zstd) are unpacked. Error: "FILE: …": unreadable, or no such database.
[[nodiscard]] Result<void> read_rosbag2_database(const std::filesystem::path& path,
                                                 const std::function<bool(const Rosbag2Message&)>& handler);

}  // namespace docent::recording
