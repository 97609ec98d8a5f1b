#include "docent/localization/markov/row_kernel.h"

#include <array>
#include <cstring>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // gcc 12's own AVX-512 header sets it off
#endif
#endif

namespace docent {

namespace {

namespace plain {
constexpr int kWidth = 4;
#define DOCENT_TARGET
#include "docent/localization/markov/row_kernel_passes.inc"
#undef DOCENT_TARGET
}  // namespace plain

#if defined(__x86_64__)

namespace avx2 {
constexpr int kWidth = 8;
#define DOCENT_TARGET __attribute__((target("avx2")))
#include "docent/localization/markov/row_kernel_passes.inc"
#undef DOCENT_TARGET
}  // namespace avx2

namespace avx512 {
constexpr int kWidth = 16;
#define DOCENT_TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi")))
#include "docent/localization/markov/row_kernel_passes.inc"
#undef DOCENT_TARGET
}  // namespace avx512

#endif

}  // namespace

const RowKernels& row_kernels(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512::kKernels;
  if (set == InstructionSet::avx2) return avx2::kKernels;
#endif
  static_cast<void>(set);
  return plain::kKernels;
}

}  // namespace docent
