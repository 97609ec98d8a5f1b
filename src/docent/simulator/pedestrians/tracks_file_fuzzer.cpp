#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/simulator/pedestrians/recording.h"
#include "docent/simulator/pedestrians/tracks_file.h"

namespace {

template <class Parsed>
void check_fault(const Parsed& parsed) {
  const std::string& message = parsed.error().message;
  if (message.rfind("file.txt:", 0) != 0 || message.find('\n') != std::string::npos) std::abort();
}

void check(const docent::simulator::Recording& recording) {
  if (!(recording.duration > 0.0) || !(recording.mean_people() >= 0.0)) std::abort();
  for (const auto& track : recording.tracks) {
    if (track.points.size() < 2 || track.start < 0.0 || track.end() > recording.duration + 0.01) std::abort();
  }
}

}  // namespace

/// Whatever people were recorded, by a camera or by us: a fault with file and line, or sound tracks.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text{reinterpret_cast<const char*>(data), size};
  const auto recording = docent::simulator::parse_recording(text, "file.txt");
  if (recording) check(*recording);
  if (!recording) check_fault(recording);
  const auto recordings = docent::simulator::parse_tracks(text, "file.txt");
  if (!recordings) check_fault(recordings);
  if (recordings) {
    for (const auto& one : *recordings) check(one);
  }
  return 0;
}
