#include "docent/collision_avoidance/velocity_kernel.h"

#include <cmath>
#include <cstring>
#include <numbers>

#if defined(__x86_64__)
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // gcc 12's own AVX-512 header sets it off
#endif
#endif

namespace docent {

namespace {

namespace plain {
#define DOCENT_TARGET
#if defined(__x86_64__)
constexpr int kWidth = 2;
#define DOCENT_SQRT(v) _mm_sqrt_pd(v)
#else
constexpr int kWidth = 1;
#define DOCENT_SQRT(v) \
  V { std::sqrt((v)[0]) }
#endif
#include "docent/collision_avoidance/velocity_kernel_passes.inc"
#undef DOCENT_SQRT
#undef DOCENT_TARGET
}  // namespace plain

#if defined(__x86_64__)

namespace avx2 {
constexpr int kWidth = 4;
#define DOCENT_TARGET __attribute__((target("avx2")))
#define DOCENT_SQRT(v) _mm256_sqrt_pd(v)
#include "docent/collision_avoidance/velocity_kernel_passes.inc"
#undef DOCENT_SQRT
#undef DOCENT_TARGET
}  // namespace avx2

namespace avx512 {
constexpr int kWidth = 8;
#define DOCENT_TARGET __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi")))
#define DOCENT_SQRT(v) _mm512_maskz_sqrt_pd(0xFF, v)
#include "docent/collision_avoidance/velocity_kernel_passes.inc"
#undef DOCENT_SQRT
#undef DOCENT_TARGET
}  // namespace avx512

#endif

}  // namespace

const VelocityKernels& velocity_kernels(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512::kKernels;
  if (set == InstructionSet::avx2) return avx2::kKernels;
#endif
  static_cast<void>(set);
  return plain::kKernels;
}

}  // namespace docent
