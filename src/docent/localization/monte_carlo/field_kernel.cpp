#include "docent/localization/monte_carlo/field_kernel.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // gcc 12's own AVX-512 header sets it off
#endif
#endif

namespace docent {

namespace {

void score_plain(const LikelihoodField::View& field, const FieldBeams& beams, const ParticleSet& particles,
                 std::uint32_t* costs) {
  const std::size_t count = particles.padded_size();
  std::fill_n(costs, count, 0U);
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.ends) {
    for (std::size_t i = 0; i < count; ++i) {
      const float column =
          std::min(std::max(particles.x[i] * field.scale + field.left, field.first_column), field.last_column);
      const float row =
          std::min(std::max(particles.y[i] * field.scale + field.bottom, field.first_row), field.last_row);
      const float c = particles.heading_x[i];
      const float s = particles.heading_y[i];
      std::uint32_t sum = 0;
      for (std::uint32_t b = begin; b < end; ++b) {
        const auto at_column = static_cast<std::int32_t>(column + (c * beams.x[b] - s * beams.y[b]));
        const auto at_row = static_cast<std::int32_t>(row + (s * beams.x[b] + c * beams.y[b]));
        sum += field.costs[at_row * field.stride + at_column];
      }
      costs[i] += std::min(sum, beams.cap);
    }
    begin = end;
  }
}

#if defined(__x86_64__)

__attribute__((target("avx2"))) void score_avx2(const LikelihoodField::View& field, const FieldBeams& beams,
                                                const ParticleSet& particles, std::uint32_t* costs) {
  const std::size_t count = particles.padded_size();
  std::fill_n(costs, count, 0U);
  const __m256i stride = _mm256_set1_epi32(field.stride);
  const __m256i byte = _mm256_set1_epi32(255);
  const __m256i cap = _mm256_set1_epi32(static_cast<int>(beams.cap));
  const __m256 scale = _mm256_set1_ps(field.scale);
  const auto clamp = [](__m256 & value, float low, float high) __attribute__((target("avx2"))) {
    value = _mm256_min_ps(_mm256_max_ps(value, _mm256_set1_ps(low)), _mm256_set1_ps(high));
  };
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.ends) {
    for (std::size_t i = 0; i < count; i += 8) {
      __m256 column = _mm256_add_ps(_mm256_mul_ps(_mm256_loadu_ps(&particles.x[i]), scale), _mm256_set1_ps(field.left));
      clamp(column, field.first_column, field.last_column);
      __m256 row = _mm256_add_ps(_mm256_mul_ps(_mm256_loadu_ps(&particles.y[i]), scale), _mm256_set1_ps(field.bottom));
      clamp(row, field.first_row, field.last_row);
      const __m256 c = _mm256_loadu_ps(&particles.heading_x[i]);
      const __m256 s = _mm256_loadu_ps(&particles.heading_y[i]);
      __m256i sum = _mm256_setzero_si256();
      for (std::uint32_t b = begin; b < end; ++b) {
        const __m256 bx = _mm256_set1_ps(beams.x[b]);
        const __m256 by = _mm256_set1_ps(beams.y[b]);
        const __m256i at_column =
            _mm256_cvttps_epi32(_mm256_add_ps(column, _mm256_sub_ps(_mm256_mul_ps(c, bx), _mm256_mul_ps(s, by))));
        const __m256i at_row =
            _mm256_cvttps_epi32(_mm256_add_ps(row, _mm256_add_ps(_mm256_mul_ps(s, bx), _mm256_mul_ps(c, by))));
        const __m256i at = _mm256_add_epi32(_mm256_mullo_epi32(at_row, stride), at_column);
        const __m256i four = _mm256_i32gather_epi32(reinterpret_cast<const int*>(field.costs), at, 1);
        sum = _mm256_add_epi32(sum, _mm256_and_si256(four, byte));
      }
      auto* const out = reinterpret_cast<__m256i*>(costs + i);
      _mm256_storeu_si256(out, _mm256_add_epi32(_mm256_loadu_si256(out), _mm256_min_epu32(sum, cap)));
    }
    begin = end;
  }
}

__attribute__((target("avx512f"))) void score_avx512(const LikelihoodField::View& field, const FieldBeams& beams,
                                                     const ParticleSet& particles, std::uint32_t* costs) {
  const std::size_t count = particles.padded_size();
  std::fill_n(costs, count, 0U);
  const __m512i stride = _mm512_set1_epi32(field.stride);
  const __m512i byte = _mm512_set1_epi32(255);
  const __m512i cap = _mm512_set1_epi32(static_cast<int>(beams.cap));
  const __m512 scale = _mm512_set1_ps(field.scale);
  const auto clamp = [](__m512 & value, float low, float high) __attribute__((target("avx512f"))) {
    value = _mm512_min_ps(_mm512_max_ps(value, _mm512_set1_ps(low)), _mm512_set1_ps(high));
  };
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.ends) {
    for (std::size_t i = 0; i < count; i += 16) {
      __m512 column = _mm512_add_ps(_mm512_mul_ps(_mm512_loadu_ps(&particles.x[i]), scale), _mm512_set1_ps(field.left));
      clamp(column, field.first_column, field.last_column);
      __m512 row = _mm512_add_ps(_mm512_mul_ps(_mm512_loadu_ps(&particles.y[i]), scale), _mm512_set1_ps(field.bottom));
      clamp(row, field.first_row, field.last_row);
      const __m512 c = _mm512_loadu_ps(&particles.heading_x[i]);
      const __m512 s = _mm512_loadu_ps(&particles.heading_y[i]);
      __m512i sum = _mm512_setzero_si512();
      for (std::uint32_t b = begin; b < end; ++b) {
        const __m512 bx = _mm512_set1_ps(beams.x[b]);
        const __m512 by = _mm512_set1_ps(beams.y[b]);
        const __m512i at_column =
            _mm512_cvttps_epi32(_mm512_add_ps(column, _mm512_sub_ps(_mm512_mul_ps(c, bx), _mm512_mul_ps(s, by))));
        const __m512i at_row =
            _mm512_cvttps_epi32(_mm512_add_ps(row, _mm512_add_ps(_mm512_mul_ps(s, bx), _mm512_mul_ps(c, by))));
        const __m512i at = _mm512_add_epi32(_mm512_mullo_epi32(at_row, stride), at_column);
        const __m512i four = _mm512_i32gather_epi32(at, field.costs, 1);
        sum = _mm512_add_epi32(sum, _mm512_and_si512(four, byte));
      }
      _mm512_storeu_si512(costs + i, _mm512_add_epi32(_mm512_loadu_si512(costs + i), _mm512_min_epu32(sum, cap)));
    }
    begin = end;
  }
}

#endif

}  // namespace

std::vector<NamedFieldKernel> field_kernels() {
  std::vector<NamedFieldKernel> kernels{{"plain", &score_plain}};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back({"avx2", &score_avx2});
  if (__builtin_cpu_supports("avx512f")) kernels.push_back({"avx512", &score_avx512});
#endif
  return kernels;
}

}  // namespace docent
