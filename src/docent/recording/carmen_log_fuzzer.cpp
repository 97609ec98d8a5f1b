#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "docent/recording/carmen_log.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto log = docent::recording::parse_carmen_log({reinterpret_cast<const char*>(data), size}, "log");
  if (!log) {
    // A fault is one line that names the file.
    const std::string& message = log.error().message;
    if (message.rfind("log:", 0) != 0 || message.find('\n') != std::string::npos) std::abort();
    return 0;
  }
  for (std::size_t i = 1; i < log->scans.size(); ++i)
    if (log->scans[i].time < log->scans[i - 1].time) std::abort();
  return 0;
}
