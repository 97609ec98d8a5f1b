#include "docent/localization/monte_carlo/field_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>

#if defined(__x86_64__)
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // gcc 12's own AVX-512 header sets it off
#endif
#endif

namespace docent::localization {

namespace {

constexpr double kBeamUnits = 16.0;       // a cell
constexpr float kHeadingUnits = 4096.0F;  // 1; both together are the 65536 units of a position
constexpr std::uint32_t kChunk = 32;      // beams whose cells are found before they are looked up

std::uint32_t packed(std::int32_t low, std::int32_t high) {
  return (static_cast<std::uint32_t>(low) & 0xFFFFU) | (static_cast<std::uint32_t>(high) << 16U);
}
std::int32_t rounded(float value) { return static_cast<std::int32_t>(value + (value < 0.0F ? -0.5F : 0.5F)); }

#if defined(__x86_64__)

/// sums[i] += the costs of the cells at[b][i], for `Lanes` particles. Plain loads, eight sums in registers: faster than
/// the gathers of most processors that have them.
template <std::size_t Lanes>
inline void look_up(const std::uint8_t* costs, const std::uint32_t* at, std::uint32_t beams, std::uint32_t* sums) {
  for (std::size_t first = 0; first < Lanes; first += 8) {
    std::uint32_t s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, s5 = 0, s6 = 0, s7 = 0;
    const std::uint32_t* cell = at + first;
    for (std::uint32_t b = 0; b < beams; ++b, cell += Lanes) {
      s0 += costs[cell[0]], s1 += costs[cell[1]], s2 += costs[cell[2]], s3 += costs[cell[3]];
      s4 += costs[cell[4]], s5 += costs[cell[5]], s6 += costs[cell[6]], s7 += costs[cell[7]];
    }
    sums[first] += s0, sums[first + 1] += s1, sums[first + 2] += s2, sums[first + 3] += s3;
    sums[first + 4] += s4, sums[first + 5] += s5, sums[first + 6] += s6, sums[first + 7] += s7;
  }
}

/// What every processor of this architecture has: SSE2, four particles at a time.
void score_plain(const LikelihoodField::View& field, const FieldBeams& beams, const FieldPoses& poses,
                 std::uint32_t* costs) {
  constexpr std::size_t kLanes = 8;  // in two halves
  const std::size_t count = poses.column.size();
  std::fill_n(costs, count, 0U);
  const __m128i stride = _mm_set1_epi32(static_cast<std::int32_t>(packed(1, field.stride)));
  const __m128i high_halves = _mm_set1_epi32(static_cast<std::int32_t>(0xFFFF0000U));
  alignas(64) std::array<std::uint32_t, kLanes * kChunk> cells;
  const auto load = [](const void* from) { return _mm_loadu_si128(static_cast<const __m128i*>(from)); };
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.sector_ends) {
    for (std::size_t i = 0; i < count; i += kLanes) {
      std::array<std::uint32_t, kLanes> sums{};
      for (std::uint32_t first = begin; first < end; first += kChunk) {
        const std::uint32_t last = std::min(first + kChunk, end);
        for (std::size_t half = 0; half < kLanes; half += 4) {
          const __m128i column = load(&poses.column[i + half]);
          const __m128i row = load(&poses.row[i + half]);
          const __m128i along_columns = load(&poses.along_columns[i + half]);
          const __m128i along_rows = load(&poses.along_rows[i + half]);
          for (std::uint32_t b = first; b < last; ++b) {
            const __m128i beam = _mm_set1_epi32(static_cast<std::int32_t>(beams.ends[b]));
            const __m128i at_column = _mm_add_epi32(column, _mm_madd_epi16(along_columns, beam));
            const __m128i at_row = _mm_add_epi32(row, _mm_madd_epi16(along_rows, beam));
            const __m128i both = _mm_or_si128(_mm_srli_epi32(at_column, 16), _mm_and_si128(at_row, high_halves));
            _mm_store_si128(reinterpret_cast<__m128i*>(cells.data() + kLanes * (b - first) + half),
                            _mm_madd_epi16(both, stride));
          }
        }
        look_up<kLanes>(field.costs, cells.data(), last - first, sums.data());
      }
      for (std::size_t lane = 0; lane < kLanes; ++lane) costs[i + lane] += std::min(sums[lane], beams.cap);
    }
    begin = end;
  }
}

__attribute__((target("avx2"))) void score_avx2(const LikelihoodField::View& field, const FieldBeams& beams,
                                                const FieldPoses& poses, std::uint32_t* costs) {
  constexpr std::size_t kLanes = 8;
  const std::size_t count = poses.column.size();
  std::fill_n(costs, count, 0U);
  // The whole parts of a row and a column, side by side, times (1, stride): the cell.
  const __m256i stride = _mm256_set1_epi32(static_cast<std::int32_t>(packed(1, field.stride)));
  alignas(64) std::array<std::uint32_t, kLanes * kChunk> cells;
  const auto load = [](const void* from) __attribute__((target("avx2"))) {
    return reinterpret_cast<const __m256i*>(from);
  };
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.sector_ends) {
    for (std::size_t i = 0; i < count; i += kLanes) {
      const __m256i column = _mm256_loadu_si256(load(&poses.column[i]));
      const __m256i row = _mm256_loadu_si256(load(&poses.row[i]));
      const __m256i along_columns = _mm256_loadu_si256(load(&poses.along_columns[i]));
      const __m256i along_rows = _mm256_loadu_si256(load(&poses.along_rows[i]));
      std::array<std::uint32_t, kLanes> sums{};
      for (std::uint32_t first = begin; first < end; first += kChunk) {
        const std::uint32_t last = std::min(first + kChunk, end);
        for (std::uint32_t b = first; b < last; ++b) {
          const __m256i beam = _mm256_set1_epi32(static_cast<std::int32_t>(beams.ends[b]));
          const __m256i at_column = _mm256_add_epi32(column, _mm256_madd_epi16(along_columns, beam));
          const __m256i at_row = _mm256_add_epi32(row, _mm256_madd_epi16(along_rows, beam));
          const __m256i both = _mm256_blend_epi16(_mm256_srli_epi32(at_column, 16), at_row, 0xAA);
          _mm256_store_si256(reinterpret_cast<__m256i*>(cells.data() + kLanes * (b - first)),
                             _mm256_madd_epi16(both, stride));
        }
        look_up<kLanes>(field.costs, cells.data(), last - first, sums.data());
      }
      for (std::size_t lane = 0; lane < kLanes; ++lane) costs[i + lane] += std::min(sums[lane], beams.cap);
    }
    begin = end;
  }
}

__attribute__((target("avx512f,avx512bw"))) void score_avx512(const LikelihoodField::View& field,
                                                              const FieldBeams& beams, const FieldPoses& poses,
                                                              std::uint32_t* costs) {
  constexpr std::size_t kLanes = 16;
  const std::size_t count = poses.column.size();
  std::fill_n(costs, count, 0U);
  const __m512i stride = _mm512_set1_epi32(static_cast<std::int32_t>(packed(1, field.stride)));
  constexpr __mmask32 kHighHalves = 0xAAAAAAAA;
  alignas(64) std::array<std::uint32_t, kLanes * kChunk> cells;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.sector_ends) {
    for (std::size_t i = 0; i < count; i += kLanes) {
      const __m512i column = _mm512_loadu_si512(&poses.column[i]);
      const __m512i row = _mm512_loadu_si512(&poses.row[i]);
      const __m512i along_columns = _mm512_loadu_si512(&poses.along_columns[i]);
      const __m512i along_rows = _mm512_loadu_si512(&poses.along_rows[i]);
      std::array<std::uint32_t, kLanes> sums{};
      for (std::uint32_t first = begin; first < end; first += kChunk) {
        const std::uint32_t last = std::min(first + kChunk, end);
        for (std::uint32_t b = first; b < last; ++b) {
          const __m512i beam = _mm512_set1_epi32(static_cast<std::int32_t>(beams.ends[b]));
          const __m512i at_column = _mm512_add_epi32(column, _mm512_madd_epi16(along_columns, beam));
          const __m512i at_row = _mm512_add_epi32(row, _mm512_madd_epi16(along_rows, beam));
          const __m512i both = _mm512_mask_blend_epi16(kHighHalves, _mm512_srli_epi32(at_column, 16), at_row);
          _mm512_store_si512(cells.data() + kLanes * (b - first), _mm512_madd_epi16(both, stride));
        }
        look_up<kLanes>(field.costs, cells.data(), last - first, sums.data());
      }
      for (std::size_t lane = 0; lane < kLanes; ++lane) costs[i + lane] += std::min(sums[lane], beams.cap);
    }
    begin = end;
  }
}

#else

std::int32_t low_of(std::uint32_t pair) { return static_cast<std::int16_t>(pair & 0xFFFFU); }
std::int32_t high_of(std::uint32_t pair) { return static_cast<std::int16_t>(pair >> 16U); }
std::int32_t product(std::uint32_t a, std::uint32_t b) { return low_of(a) * low_of(b) + high_of(a) * high_of(b); }

void score_plain(const LikelihoodField::View& field, const FieldBeams& beams, const FieldPoses& poses,
                 std::uint32_t* costs) {
  const std::size_t count = poses.column.size();
  std::fill_n(costs, count, 0U);
  std::uint32_t begin = 0;
  for (const std::uint32_t end : beams.sector_ends) {
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t sum = 0;
      for (std::uint32_t b = begin; b < end; ++b) {
        const std::int32_t column = (poses.column[i] + product(poses.along_columns[i], beams.ends[b])) >> 16;
        const std::int32_t row = (poses.row[i] + product(poses.along_rows[i], beams.ends[b])) >> 16;
        sum += field.costs[row * field.stride + column];
      }
      costs[i] += std::min(sum, beams.cap);
    }
    begin = end;
  }
}

#endif

}  // namespace

void FieldBeams::add(const LikelihoodField::View& field, Point2 end) {
  const double units = kBeamUnits * static_cast<double>(field.scale);
  ends.push_back(packed(static_cast<std::int32_t>(std::lround(end.x * units)),
                        static_cast<std::int32_t>(std::lround(end.y * units))));
}

void FieldPoses::fill(const LikelihoodField::View& field, const ParticleSet& particles) {
  const std::size_t count = particles.padded_size();
  for (auto* const values : {&column, &row}) values->resize(count);
  for (auto* const values : {&along_columns, &along_rows}) values->resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float x = particles.x[i] * field.scale + field.left;
    const float y = particles.y[i] * field.scale + field.bottom;
    column[i] = static_cast<std::int32_t>(std::min(std::max(x, field.first_column), field.last_column) * 65536.0F);
    row[i] = static_cast<std::int32_t>(std::min(std::max(y, field.first_row), field.last_row) * 65536.0F);
    const std::int32_t c = rounded(particles.heading_x[i] * kHeadingUnits);
    const std::int32_t s = rounded(particles.heading_y[i] * kHeadingUnits);
    along_columns[i] = packed(c, -s);
    along_rows[i] = packed(s, c);
  }
}

std::vector<NamedFieldKernel> field_kernels() {
  std::vector<NamedFieldKernel> kernels{{"plain", &score_plain}};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back({"avx2", &score_avx2});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw"))
    kernels.push_back({"avx512", &score_avx512});
#endif
  return kernels;
}

}  // namespace docent::localization
