#include "docent/base/instruction_set.h"

#include <algorithm>

namespace docent {

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> sets{InstructionSet::plain};
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) return sets;
  sets.push_back(InstructionSet::avx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512vbmi"))
    sets.push_back(InstructionSet::avx512);
#endif
  return sets;
}

std::string_view name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::plain:
      return "plain";
    case InstructionSet::avx2:
      return "avx2";
    case InstructionSet::avx512:
      return "avx512";
  }
  return "plain";
}

Result<InstructionSet> instruction_set_of(const std::string& name) {
  const std::vector<InstructionSet> sets = instruction_sets();
  if (name == "auto") return sets.back();
  for (const InstructionSet set : {InstructionSet::plain, InstructionSet::avx2, InstructionSet::avx512}) {
    if (name != name_of(set)) continue;
    if (std::find(sets.begin(), sets.end(), set) == sets.end()) return fail("this processor has no " + name);
    return set;
  }
  return fail("simd must be auto, plain, avx2 or avx512");
}

}  // namespace docent
