#pragma once

#include <vector>

#include "fuzz_replay.h"

namespace docent {

/// All of this build; CMakeLists.txt writes them.
extern const std::vector<Fuzzer> kFuzzers;

}  // namespace docent
