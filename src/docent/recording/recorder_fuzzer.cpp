#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "docent/recording/recorder.h"

/// A recording from anywhere: its MCAP structure, and the messages in it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto reader = docent::recording::McapReader::from_bytes({data, data + size}, "fuzz");
  if (!reader) return 0;
  docent::recording::McapReader::Selection everything;
  everything.skip_damaged = true;
  docent::Time last{};
  if (!reader->read(everything, [&](const docent::recording::McapMessage& message) {
        if (message.log_time < last) std::abort();
        last = message.log_time;
        return true;
      }))
    return 0;
  (void)docent::recording::read_recording(*reader, everything,
                                          [](const docent::recording::RecordedMessage&) { return true; });
  (void)reader->counts_by_topic();
  return 0;
}
