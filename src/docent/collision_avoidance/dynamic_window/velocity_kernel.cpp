#include "docent/collision_avoidance/dynamic_window/velocity_kernel.h"

#include <cmath>
#include <cstring>
#include <numbers>

#include "docent/base/kernel_targets.h"

namespace docent::collision_avoidance {

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
#include "docent/collision_avoidance/dynamic_window/velocity_kernel_passes.inc"
#undef DOCENT_SQRT
#undef DOCENT_TARGET
}  // namespace plain

#if defined(__x86_64__)

namespace avx2 {
constexpr int kWidth = 4;
#define DOCENT_TARGET DOCENT_AVX2
#define DOCENT_SQRT(v) _mm256_sqrt_pd(v)
#include "docent/collision_avoidance/dynamic_window/velocity_kernel_passes.inc"
#undef DOCENT_SQRT
#undef DOCENT_TARGET
}  // namespace avx2

namespace avx512 {
constexpr int kWidth = 8;
#define DOCENT_TARGET DOCENT_AVX512
#define DOCENT_SQRT(v) _mm512_maskz_sqrt_pd(0xFF, v)
#include "docent/collision_avoidance/dynamic_window/velocity_kernel_passes.inc"
#undef DOCENT_SQRT
#undef DOCENT_TARGET
}  // namespace avx512

#endif

}  // namespace

const VelocityKernels& velocity_kernels(InstructionSet set) {
  return kernels_for<VelocityKernels>(set, DOCENT_KERNELS);
}

}  // namespace docent::collision_avoidance
