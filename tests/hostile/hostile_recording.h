#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/time.h"

// Recordings that decode and yet hold what no robot ever measured.

namespace docent {

/// A message as a recording holds it.
struct RawMessage {
  std::string topic;
  std::string type;
  Time time;
  std::vector<std::uint8_t> data;  ///< CDR
};

/// Twelve seconds of a drive round a room of 10 x 8 m (`write_room_map`): laser, sonars, odometry and the laser's
/// place. Seed 0 is an honest drive; every other seed spoils some topics, by fields, by counts or by the clock.
[[nodiscard]] std::vector<RawMessage> hostile_drive(std::uint64_t seed);

void write_mcap(const std::filesystem::path& path, const std::vector<RawMessage>& messages);
void write_rosbag2(const std::filesystem::path& path, const std::vector<RawMessage>& messages);

/// FOLDER/room.yaml and its picture.
void write_room_map(const std::filesystem::path& folder);

}  // namespace docent
