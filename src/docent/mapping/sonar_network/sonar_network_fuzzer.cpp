#include <cstddef>
#include <cstdint>
#include <string>

#include "docent/mapping/sonar_network/sonar_network.h"

// A file of a sonar network: refused, or one that can be asked.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto network = docent::mapping::SonarNetwork::parse(text, "fuzz");
  if (network) (void)network->probability({});
  return 0;
}
