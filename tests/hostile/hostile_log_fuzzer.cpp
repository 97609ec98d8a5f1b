#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "docent/apps/localize/localize_log.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/recording/laser_log.h"
#include "hostile_recording.h"

// Recordings that decode: the input is the seed of one, and what is written over the bytes of its messages. They go
// through a file, by turns as MCAP and as rosbag2, are read and localized.

namespace {

struct Room {
  Room() {
    std::string name = (std::filesystem::temp_directory_path() / "docent-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    path = name;
    docent::write_room_map(path);
    auto map = docent::load_map(path / "room.yaml");
    if (!map) std::abort();
    docent::localization::LocalizerParams params;
    params.states.cell_size = 0.5;
    params.states.heading_step = 10.0;
    localizer.emplace(*map, params, docent::localization::RangeTableCache{}, 1);
  }
  ~Room() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
  std::optional<docent::localization::MarkovLocalizer> localizer;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Room room;
  if (size < 2) return 0;
  auto messages = docent::hostile_drive(data[0]);
  messages.resize(std::min<std::size_t>(messages.size(), 120));
  // Message, place in it, how many bytes, the bytes.
  for (std::size_t at = 2; at + 5 < size;) {
    std::uint16_t message = 0, place = 0;
    std::memcpy(&message, data + at, 2);
    std::memcpy(&place, data + at + 2, 2);
    auto& bytes = messages[message % messages.size()].data;
    const std::size_t length = std::min({std::size_t{data[at + 4]} % 16, size - at - 5, bytes.size()});
    if (!bytes.empty())
      std::memcpy(bytes.data() + std::min<std::size_t>(place, bytes.size() - length), data + at + 5, length);
    at += 5 + length;
  }
  const bool is_mcap = data[1] % 2 == 0;
  const auto path = room.path / (is_mcap ? "drive.mcap" : "drive.db3");
  (is_mcap ? docent::write_mcap : docent::write_rosbag2)(path, messages);
  const auto log = docent::recording::read_laser_log(path, {.with_sonars = true});
  if (!log) {
    if (log.error().message.rfind(path.string() + ": ", 0) != 0) std::abort();
    return 0;
  }
  room.localizer->start_unknown();
  for (const auto& pose : docent::apps::localize_command::localize_log(*log, *room.localizer, {}).poses)
    if (pose.has_pose && !std::isfinite(pose.map_from_base.x)) std::abort();
  return 0;
}
