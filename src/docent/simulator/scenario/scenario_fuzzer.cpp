#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/simulator/scenario/scenario.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto scenario = docent::simulator::parse_scenario(text, "fuzz.yaml");
  // A fault is one line that names the file.
  if (!scenario && scenario.error().message.rfind("fuzz.yaml:", 0) != 0) std::abort();
  return 0;
}
