#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "docent/recording/recorder.h"

/// A recording from anywhere: its MCAP structure, and the messages in it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto reader = docent::McapReader::from_bytes({data, data + size}, "fuzz");
  if (!reader) return 0;
  docent::McapReader::Selection everything;
  everything.skip_damaged = true;
  docent::Time last{};
  if (!reader->read(everything, [&](const docent::McapMessage& message) {
        if (message.log_time < last) std::abort();
        last = message.log_time;
        return true;
      }))
    return 0;
  (void)docent::read_recording(*reader, everything, [](const docent::RecordedMessage&) { return true; });
  (void)reader->counts_by_topic();
  return 0;
}
