// docent_hostile_recordings FOLDER COUNT: the map of a room, and recordings of the seeds 0 to COUNT - 1, every other
// one as a rosbag2 database. To look at by hand: docent localize --map FOLDER/room.yaml --log FOLDER/3.db3
#include <cstdio>
#include <cstdlib>

#include "hostile_recording.h"

int main(int count, char** words) {
  if (count != 3) {
    std::fprintf(stderr, "usage: docent_hostile_recordings FOLDER COUNT\n");
    return 2;
  }
  const std::filesystem::path folder = words[1];
  std::filesystem::create_directories(folder);
  docent::write_room_map(folder);
  for (long seed = 0; seed < std::atol(words[2]); ++seed) {
    const auto messages = docent::hostile_drive(static_cast<std::uint64_t>(seed));
    const std::string name = std::to_string(seed);
    seed % 2 == 0 ? docent::write_mcap(folder / (name + ".mcap"), messages)
                  : docent::write_rosbag2(folder / (name + ".db3"), messages);
  }
}
