#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/simulator/world/world.h"

/// Whatever simulation.yaml holds: a fault or a sound world.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text{reinterpret_cast<const char*>(data), size};
  const auto world = docent::simulator::parse_world(text, "simulation.yaml");
  if (!world) return 0;
  for (const auto& solid : world->solids) {
    if (solid.polygon.size() < 3) std::abort();
  }
  return 0;
}
