#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "docent/interaction/attract/trial_memory.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace docent::interaction;
  const auto trials = parse_trials({reinterpret_cast<const char*>(data), size}, "memory.json");
  if (!trials) {
    if (trials.error().message.rfind("memory.json: ", 0) != 0) std::abort();
    return 0;
  }
  for (const AttractionTrial& trial : *trials) {
    const double chance = trial.chances.at(static_cast<std::size_t>(style_of(trial.action)));
    if (!std::isfinite(trial.reward) || !(trial.density >= 0.0) || !(chance > 0.0)) std::abort();
  }
  return 0;
}
