#include "docent/localization/markov/score_kernel.h"

#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // gcc 12's own AVX-512 header sets it off
#endif
#endif

namespace docent {

namespace {

void score_plain(const std::uint8_t* row, std::size_t first_heading, std::size_t count,
                 std::span<const BeamCosts> beams, std::uint16_t* sums) {
  std::memset(sums, 0, count * sizeof(std::uint16_t));
  for (const BeamCosts& beam : beams) {
    const std::uint8_t* const seen = row + first_heading + beam.direction;
    const std::uint8_t* const costs = beam.costs.data();
    for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + costs[seen[i] & 127U]);
  }
}

#if defined(__x86_64__)

/// The look-up of 128 entries is eight shuffles of 16. For shuffle t the index is moved down by 16 t; adding 0x70 with
/// saturation leaves bit 7 clear only for 0..15, and a shuffle gives zero where bit 7 is set.
__attribute__((target("avx2"))) inline __m256i look_up_avx2(__m256i index, const __m256i* tables) {
  const __m256i guard = _mm256_set1_epi8(0x70);
  const __m256i sixteen = _mm256_set1_epi8(16);
  __m256i result = _mm256_setzero_si256();
  for (int t = 0; t < 8; ++t) {
    result = _mm256_or_si256(result, _mm256_shuffle_epi8(tables[t], _mm256_adds_epu8(index, guard)));
    index = _mm256_sub_epi8(index, sixteen);
  }
  return result;
}

__attribute__((target("avx2"))) inline void load_tables_avx2(const BeamCosts& beam, __m256i* tables) {
  for (int t = 0; t < 8; ++t)
    tables[t] = _mm256_broadcastsi128_si256(_mm_loadu_si128(
        reinterpret_cast<const __m128i*>(beam.costs.data() + std::size_t{16} * static_cast<std::size_t>(t))));
}

__attribute__((target("avx2"))) void score_avx2(const std::uint8_t* row, std::size_t first_heading, std::size_t count,
                                                std::span<const BeamCosts> beams, std::uint16_t* sums) {
  const std::size_t blocks = (count + 31) / 32;
  std::memset(sums, 0, blocks * 64);
  for (std::size_t b = 0; b < beams.size(); ++b) {
    __m256i tables[8];
    load_tables_avx2(beams[b], tables);
    const std::uint8_t* const seen = row + first_heading + beams[b].direction;
    for (std::size_t block = 0; block < blocks; ++block) {
      const __m256i index = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(seen + block * 32));
      const __m256i cost = look_up_avx2(index, tables);
      auto* const out = reinterpret_cast<__m256i*>(sums + block * 32);
      const __m256i low = _mm256_cvtepu8_epi16(_mm256_castsi256_si128(cost));
      const __m256i high = _mm256_cvtepu8_epi16(_mm256_extracti128_si256(cost, 1));
      _mm256_storeu_si256(out, _mm256_add_epi16(_mm256_loadu_si256(out), low));
      _mm256_storeu_si256(out + 1, _mm256_add_epi16(_mm256_loadu_si256(out + 1), high));
    }
  }
}

__attribute__((target("avx512f,avx512bw,avx512vbmi"))) void score_avx512(const std::uint8_t* row,
                                                                         std::size_t first_heading, std::size_t count,
                                                                         std::span<const BeamCosts> beams,
                                                                         std::uint16_t* sums) {
  const std::size_t blocks = (count + 63) / 64;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::uint8_t* const seen = row + first_heading + block * 64;
    __m512i low = _mm512_setzero_si512();
    __m512i high = _mm512_setzero_si512();
    const auto cost_of = [seen](const BeamCosts& beam) __attribute__((target("avx512f,avx512bw,avx512vbmi"))) {
      return _mm512_permutex2var_epi8(_mm512_loadu_si512(beam.costs.data()), _mm512_loadu_si512(seen + beam.direction),
                                      _mm512_loadu_si512(beam.costs.data() + 64));
    };
    std::size_t b = 0;
    for (; b + 1 < beams.size(); b += 2) {  // two costs fit in a byte
      const __m512i cost = _mm512_add_epi8(cost_of(beams[b]), cost_of(beams[b + 1]));
      low = _mm512_add_epi16(low, _mm512_cvtepu8_epi16(_mm512_castsi512_si256(cost)));
      high = _mm512_add_epi16(high, _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(cost, 1)));
    }
    if (b < beams.size()) {
      const __m512i cost = cost_of(beams[b]);
      low = _mm512_add_epi16(low, _mm512_cvtepu8_epi16(_mm512_castsi512_si256(cost)));
      high = _mm512_add_epi16(high, _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(cost, 1)));
    }
    _mm512_storeu_si512(sums + block * 64, low);
    _mm512_storeu_si512(sums + block * 64 + 32, high);
  }
}

#endif

}  // namespace

std::vector<NamedScoreKernel> score_kernels() {
  std::vector<NamedScoreKernel> kernels{{"plain", &score_plain}};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back({"avx2", &score_avx2});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vbmi"))
    kernels.push_back({"avx512vbmi", &score_avx512});
#endif
  return kernels;
}

}  // namespace docent
