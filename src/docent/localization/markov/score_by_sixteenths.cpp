#include "docent/localization/markov/score_by_sixteenths.h"

#include <algorithm>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace docent {

namespace {

constexpr std::size_t kSixteenths = kExpectedRanges / 16;

}  // namespace

SixteenthScorer::SixteenthScorer(std::size_t headings)
    : headings_{headings},
      indices_(headings * kSixteenths / 2 + 1),
      offsets_(headings * kSixteenths + 1),
      lines_(headings),
      part_((headings + 1) / 2),
      group_((headings + 1) / 2),
      wide_(headings * kHalf) {}

#if defined(__x86_64__)

#define DOCENT_AVX2 __attribute__((target("avx2")))
#define DOCENT_INLINE __attribute__((always_inline)) inline

namespace {

__m256i* vectors(std::vector<TileScorer::Line>& lines) { return reinterpret_cast<__m256i*>(lines.data()); }

/// Lines [begin, end) of beams: acc[-direction] += costs, where the places of the line lie in kVectors sixteenths.
template <std::size_t kVectors>
DOCENT_AVX2 DOCENT_INLINE void add_line(const std::uint8_t* table, const std::uint32_t* direction, std::size_t beams,
                                        const __m256i* indices, const std::uint32_t* offsets, __m256i* sums) {
  __m256i index[kVectors];
  std::size_t offset[kVectors];
  for (std::size_t i = 0; i < kVectors; ++i) {
    index[i] = _mm256_load_si256(indices + i);
    offset[i] = offsets[i];
  }
#pragma GCC unroll 4
  for (std::size_t beam = 0; beam < beams; ++beam, table += kExpectedRanges) {
    __m256i cost = _mm256_setzero_si256();
    for (std::size_t i = 0; i < kVectors; ++i) {
      const __m128i costs = _mm_load_si128(reinterpret_cast<const __m128i*>(table + offset[i]));
      const __m256i found = _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(costs), index[i]);
      cost = i == 0 ? found : _mm256_or_si256(cost, found);
    }
    __m256i* const sum = sums - direction[beam];
    _mm256_store_si256(sum, _mm256_adds_epu8(_mm256_load_si256(sum), cost));
  }
}

DOCENT_AVX2 DOCENT_INLINE void widen(const __m256i& bytes, std::uint16_t* sums) {
  auto* const out = reinterpret_cast<__m256i*>(sums);
  const __m256i low = _mm256_cvtepu8_epi16(_mm256_castsi256_si128(bytes));
  const __m256i high = _mm256_cvtepu8_epi16(_mm256_extracti128_si256(bytes, 1));
  _mm256_storeu_si256(out, _mm256_add_epi16(_mm256_loadu_si256(out), low));
  _mm256_storeu_si256(out + 1, _mm256_add_epi16(_mm256_loadu_si256(out + 1), high));
}

}  // namespace

DOCENT_AVX2 void SixteenthScorer::load(const std::uint8_t* tile, std::size_t half) {
  const __m256i others = _mm256_set1_epi8(0x70);
  __m256i* const out = vectors(indices_);
  std::uint32_t next = 0;
  for (std::size_t line = 0; line < headings_; ++line) {
    const __m256i index =
        _mm256_load_si256(reinterpret_cast<const __m256i*>(tile + line * RangeTable::kTile + half * kHalf));
    lines_[line].begin = next;
    for (std::size_t sixteenth = 0; sixteenth < kSixteenths; ++sixteenth) {
      // 0..15 in the lanes of this sixteenth and 16..127 in others; bit 7 of those follows by an addition.
      const __m256i first = _mm256_set1_epi8(static_cast<char>(16 * sixteenth));
      const __m256i vector = _mm256_adds_epu8(_mm256_xor_si256(index, first), others);
      _mm256_store_si256(out + next, vector);
      offsets_[next] = static_cast<std::uint32_t>(16 * sixteenth);
      next += _mm256_movemask_epi8(vector) != -1 ? 1U : 0U;  // written anyway: no branch to mispredict
    }
    lines_[line].end = next;
  }
}

/// part_ [run.count] gets the sums of the beams, saturated.
DOCENT_AVX2 void SixteenthScorer::add_beams(const TileScorer::Plan& plan, const TileScorer::Line* tables,
                                            TileScorer::Sector beams, Run run) {
  __m256i* const part = vectors(part_);
  std::fill_n(part_.begin(), (run.count + 1) / 2, TileScorer::Line{});
  const std::uint32_t* const directions = plan.directions.data();
  // A line is where heading + direction leads; beams from `begin` to `end` reach it from headings of the run.
  std::size_t begin = beams.first;
  std::size_t end = beams.first;
  const std::size_t last = run.first + run.count - 1 + directions[beams.last - 1];
  for (std::size_t at = run.first + directions[beams.first]; at <= last; ++at) {
    while (end < beams.last && run.first + directions[end] <= at) ++end;
    while (begin < end && run.first + run.count - 1 + directions[begin] < at) ++begin;
    const Stretch line = lines_[at < headings_ ? at : at - headings_];
    const std::uint8_t* const table = tables[2 * begin].bytes.data();
    const std::uint32_t* const direction = directions + begin;
    __m256i* const sums = part + (at - run.first);
    std::uint32_t i = line.begin;
    for (; i + 2 <= line.end; i += 2)
      add_line<2>(table, direction, end - begin, vectors(indices_) + i, offsets_.data() + i, sums);
    if (i < line.end) add_line<1>(table, direction, end - begin, vectors(indices_) + i, offsets_.data() + i, sums);
  }
}

DOCENT_AVX2 void SixteenthScorer::score(const TileScorer::Plan& plan, const TileScorer::Line* tables, std::size_t first,
                                        std::size_t count, std::uint16_t* sums) {
  for (std::size_t k = 0; k < count; ++k) std::fill_n(sums + k * RangeTable::kTile, kHalf, std::uint16_t{0});
  const __m256i* const part = vectors(part_);
  const Run run{first, count};
  if (plan.capped_in_byte > 0) {
    __m256i* const group = vectors(group_);
    const __m256i cap = _mm256_set1_epi8(static_cast<char>(plan.cap));
    std::fill_n(group_.begin(), (count + 1) / 2, TileScorer::Line{});
    for (std::size_t s = 0; s < plan.sectors.size(); ++s) {
      add_beams(plan, tables, plan.sectors[s], run);
      const bool full = (s + 1) % plan.capped_in_byte == 0 || s + 1 == plan.sectors.size();
      for (std::size_t k = 0; k < count; ++k) group[k] = _mm256_add_epi8(group[k], _mm256_min_epu8(part[k], cap));
      if (!full) continue;
      for (std::size_t k = 0; k < count; ++k) {
        widen(group[k], sums + k * RangeTable::kTile);
        group[k] = _mm256_setzero_si256();
      }
    }
    return;
  }
  for (const TileScorer::Sector& sector : plan.sectors) {
    std::fill_n(wide_.begin(), count * kHalf, std::uint16_t{0});
    for (std::size_t beam = sector.first; beam < sector.last; beam += plan.beams_in_byte) {
      add_beams(plan, tables, {beam, std::min(beam + plan.beams_in_byte, sector.last)}, run);
      for (std::size_t k = 0; k < count; ++k) widen(part[k], wide_.data() + k * kHalf);
    }
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < kHalf; ++i)
        sums[k * RangeTable::kTile + i] = static_cast<std::uint16_t>(
            sums[k * RangeTable::kTile + i] + std::min<std::uint16_t>(wide_[k * kHalf + i], plan.cap));
  }
}

#endif

}  // namespace docent
