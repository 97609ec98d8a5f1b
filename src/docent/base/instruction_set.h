#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"

namespace docent {

/// What hot loops are compiled for, each a superset of the one before. `plain` is what every processor of the
/// architecture has (on x86-64 that includes SSE2). All sets give the same results, bit for bit.
enum class InstructionSet {
  plain,
  avx2,
  avx512  ///< F, BW, DQ, VL and VBMI: Ice Lake, Zen 4 and later
};

/// Those that this processor can run, plain first, the widest last.
[[nodiscard]] std::vector<InstructionSet> instruction_sets();
[[nodiscard]] std::string_view name_of(InstructionSet set);
/// `auto` is the widest one. Error: an unknown name, or a set that this processor lacks.
[[nodiscard]] Result<InstructionSet> instruction_set_of(const std::string& name);

}  // namespace docent
