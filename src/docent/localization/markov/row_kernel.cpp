#include "docent/localization/markov/row_kernel.h"

#include <array>
#include <cstring>
#include <utility>

#include "docent/base/kernel_targets.h"

namespace docent::localization {

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
#define DOCENT_TARGET DOCENT_AVX2
#include "docent/localization/markov/row_kernel_passes.inc"
#undef DOCENT_TARGET
}  // namespace avx2

namespace avx512 {
constexpr int kWidth = 16;
#define DOCENT_TARGET DOCENT_AVX512
#include "docent/localization/markov/row_kernel_passes.inc"
#undef DOCENT_TARGET
}  // namespace avx512

#endif

}  // namespace

const RowKernels& row_kernels(InstructionSet set) { return kernels_for<RowKernels>(set, DOCENT_KERNELS); }

}  // namespace docent::localization
