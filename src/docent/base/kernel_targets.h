#pragma once

#include <cstddef>
#include <initializer_list>

#include "docent/base/instruction_set.h"

#if defined(__x86_64__)
#if defined(__GNUC__) && !defined(__clang__)
// gcc 12's own AVX-512 header sets it off wherever its functions are inlined: in all of a file with such kernels.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#endif

/// For sources that compile the same loops once for every InstructionSet: each in a namespace `plain`, `avx2` or
/// `avx512` with its `kKernels`, and with functions that carry the set as an attribute.
#if defined(__x86_64__)
#define DOCENT_AVX2 __attribute__((target("avx2")))
#define DOCENT_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi")))
#define DOCENT_KERNELS \
  { &plain::kKernels, &avx2::kKernels, &avx512::kKernels }
#else
#define DOCENT_KERNELS \
  { &plain::kKernels }
#endif

namespace docent {

/// Those of a set. `all`: in the order of the sets, as far as this architecture has them. @pre `all` is not empty
template <class Kernels>
[[nodiscard]] const Kernels& kernels_for(InstructionSet set, std::initializer_list<const Kernels*> all) {
  const auto wanted = static_cast<std::size_t>(set);
  return **(all.begin() + (wanted < all.size() ? wanted : all.size() - 1));
}

}  // namespace docent
