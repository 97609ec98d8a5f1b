#include "docent/planning/value_iteration/tile_kernel.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

#include "docent/base/kernel_targets.h"

namespace docent::planning {

namespace {

#if !defined(__x86_64__)
/// A bit for each lane that is set.
template <class Mask>
std::uint64_t collect_bits(const Mask& set, int width) {
  std::uint64_t bits = 0;
  for (int i = 0; i < width; ++i) bits |= static_cast<std::uint64_t>(set[i] & 1) << i;
  return bits;
}
#endif

namespace plain {
constexpr int kWidth = 4;
#define DOCENT_TARGET
#if defined(__x86_64__)
#define DOCENT_BITS(set) static_cast<std::uint64_t>(_mm_movemask_ps(std::bit_cast<__m128>(set)))
#else
#define DOCENT_BITS(set) collect_bits(set, kWidth)
#endif
#include "docent/planning/value_iteration/tile_kernel_passes.inc"
#undef DOCENT_BITS
#undef DOCENT_TARGET
}  // namespace plain

#if defined(__x86_64__)

namespace avx2 {
constexpr int kWidth = 8;
#define DOCENT_TARGET DOCENT_AVX2
#define DOCENT_BITS(set) static_cast<std::uint64_t>(_mm256_movemask_ps(__builtin_bit_cast(__m256, set)))
#include "docent/planning/value_iteration/tile_kernel_passes.inc"
#undef DOCENT_BITS
#undef DOCENT_TARGET
}  // namespace avx2

namespace avx512 {
constexpr int kWidth = 16;
#define DOCENT_TARGET DOCENT_AVX512
#define DOCENT_BITS(set) static_cast<std::uint64_t>(_mm512_movepi32_mask(__builtin_bit_cast(__m512i, set)))
#include "docent/planning/value_iteration/tile_kernel_passes.inc"
#undef DOCENT_BITS
#undef DOCENT_TARGET
}  // namespace avx512

#endif

}  // namespace

const TileKernels& tile_kernels(InstructionSet set) { return kernels_for<TileKernels>(set, DOCENT_KERNELS); }

}  // namespace docent::planning
