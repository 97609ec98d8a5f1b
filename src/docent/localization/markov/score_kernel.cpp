#include "docent/localization/markov/score_kernel.h"

#include <algorithm>
#include <cstring>

#include "docent/base/kernel_targets.h"
#include "docent/localization/markov/score_by_sixteenths.h"

namespace docent::localization {

namespace {

constexpr std::size_t kTile = RangeTable::kTile;
constexpr std::size_t kBlock = TileScorer::kBlock;
using Line = TileScorer::Line;
using Plan = TileScorer::Plan;

/// Where a beam finds its expected ranges at the first heading of a block; the tile is long enough for the rest.
std::size_t first_line(const Plan& plan, std::size_t beam, std::size_t first_heading) {
  const std::size_t at = first_heading + plan.directions[beam];
  return at < plan.headings ? at : at - plan.headings;
}

/// A beam at one heading. Not inlined: what compilers make of this loop within others is twice as slow, or not, by
/// chance.
[[gnu::noinline]] void add_costs(const std::uint8_t* costs, const std::uint8_t* seen, std::uint32_t* sums) {
  for (std::size_t i = 0; i < kTile; ++i) sums[i] += costs[seen[i]];
}

/// The plain kernel: [2] lines of tables a beam, the tile as it is.
void score_plain(const Plan& plan, const Line* tables, const Line* tile, std::size_t first, std::size_t count,
                 std::uint16_t* sums) {
  std::array<std::uint32_t, kTile> part;  // whole registers: parts of them are slower to write
  std::fill_n(sums, count * kTile, std::uint16_t{0});
  for (std::size_t k = 0; k < count; ++k) {
    std::uint16_t* const out = sums + k * kTile;
    for (const TileScorer::Sector& sector : plan.sectors) {
      part.fill(0);
      for (std::size_t beam = sector.first; beam < sector.last; ++beam) {
        const std::uint8_t* const costs = tables[2 * beam].bytes.data();
        const std::uint8_t* const seen = tile[first_line(plan, beam, first) + k].bytes.data();
        add_costs(costs, seen, part.data());
      }
      for (std::size_t i = 0; i < kTile; ++i)
        out[i] = static_cast<std::uint16_t>(out[i] + std::min<std::uint32_t>(part[i], plan.cap));
    }
  }
}

#if defined(__x86_64__)

#define DOCENT_INLINE __attribute__((always_inline)) inline

DOCENT_AVX512 DOCENT_INLINE void widen_avx512(const __m512i& bytes, std::uint16_t* sums, std::uint16_t cap) {
  const __m512i most = _mm512_set1_epi16(static_cast<short>(cap));
  const __m512i low = _mm512_cvtepu8_epi16(_mm512_castsi512_si256(bytes));
  const __m512i high = _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64(bytes, 1));
  _mm512_storeu_si512(sums, _mm512_min_epu16(most, _mm512_add_epi16(_mm512_loadu_si512(sums), low)));
  _mm512_storeu_si512(sums + 32, _mm512_min_epu16(most, _mm512_add_epi16(_mm512_loadu_si512(sums + 32), high)));
}

/// `part` [kCount] gets the sums of the beams, saturated: sixteen headings stay in registers, and so does the table.
template <std::size_t kCount>
DOCENT_AVX512 DOCENT_INLINE void add_beams_avx512(const Plan& plan, const Line* tables, const Line* tile,
                                                  TileScorer::Sector beams, std::size_t first, __m512i* part) {
  for (std::size_t k = 0; k < kCount; ++k) part[k] = _mm512_setzero_si512();
  for (std::size_t beam = beams.first; beam < beams.last; ++beam) {
    const __m512i low = _mm512_load_si512(tables + 2 * beam);
    const __m512i high = _mm512_load_si512(tables + 2 * beam + 1);
    const Line* const seen = tile + first_line(plan, beam, first);
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kCount; ++k)
      part[k] = _mm512_adds_epu8(part[k], _mm512_permutex2var_epi8(low, _mm512_load_si512(seen + k), high));
  }
}

template <std::size_t kCount>
DOCENT_AVX512 void score_some_avx512(const Plan& plan, const Line* tables, const Line* tile, std::size_t first,
                                     std::uint16_t* sums) {
  __m512i part[kCount];
  std::fill_n(sums, kCount * kTile, std::uint16_t{0});
  if (plan.capped_in_byte > 0) {
    __m512i group[kCount];
    for (std::size_t k = 0; k < kCount; ++k) group[k] = _mm512_setzero_si512();
    const __m512i cap = _mm512_set1_epi8(static_cast<char>(plan.cap));
    for (std::size_t s = 0; s < plan.sectors.size(); ++s) {
      add_beams_avx512<kCount>(plan, tables, tile, plan.sectors[s], first, part);
      for (std::size_t k = 0; k < kCount; ++k) group[k] = _mm512_add_epi8(group[k], _mm512_min_epu8(part[k], cap));
      if ((s + 1) % plan.capped_in_byte != 0 && s + 1 < plan.sectors.size()) continue;
      for (std::size_t k = 0; k < kCount; ++k) {
        widen_avx512(group[k], sums + k * kTile, 0xffff);
        group[k] = _mm512_setzero_si512();
      }
    }
    return;
  }
  std::array<std::uint16_t, kCount * kTile> wide;
  for (const TileScorer::Sector& sector : plan.sectors) {
    wide.fill(0);
    for (std::size_t beam = sector.first; beam < sector.last; beam += plan.beams_in_byte) {
      add_beams_avx512<kCount>(plan, tables, tile, {beam, std::min(beam + plan.beams_in_byte, sector.last)}, first,
                               part);
      for (std::size_t k = 0; k < kCount; ++k) widen_avx512(part[k], wide.data() + k * kTile, plan.cap);
    }
    for (std::size_t i = 0; i < wide.size(); ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + wide[i]);
  }
}

DOCENT_AVX512 void score_avx512(const Plan& plan, const Line* tables, const Line* tile, std::size_t first,
                                std::size_t count, std::uint16_t* sums) {
  if (count == kBlock) return score_some_avx512<kBlock>(plan, tables, tile, first, sums);
  // The tile has kBlock directions more than headings, so that a few too many may be scored.
  for (std::size_t k = 0; k < count; k += 4) score_some_avx512<4>(plan, tables, tile, first + k, sums + k * kTile);
}

/// out[place][heading] = in[heading][place], 8 by 8.
DOCENT_INLINE void transpose_8x8(const std::uint16_t* in, std::uint16_t* const* rows, std::size_t at) {
  __m128i a[8];
  __m128i b[8];
  for (std::size_t i = 0; i < 8; ++i) a[i] = _mm_load_si128(reinterpret_cast<const __m128i*>(in + i * kTile));
  for (std::size_t i = 0; i < 4; ++i) {
    b[2 * i] = _mm_unpacklo_epi16(a[2 * i], a[2 * i + 1]);
    b[2 * i + 1] = _mm_unpackhi_epi16(a[2 * i], a[2 * i + 1]);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    a[4 * i] = _mm_unpacklo_epi32(b[4 * i], b[4 * i + 2]);
    a[4 * i + 1] = _mm_unpackhi_epi32(b[4 * i], b[4 * i + 2]);
    a[4 * i + 2] = _mm_unpacklo_epi32(b[4 * i + 1], b[4 * i + 3]);
    a[4 * i + 3] = _mm_unpackhi_epi32(b[4 * i + 1], b[4 * i + 3]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(rows[2 * i] + at), _mm_unpacklo_epi64(a[i], a[i + 4]));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(rows[2 * i + 1] + at), _mm_unpackhi_epi64(a[i], a[i + 4]));
  }
}

#endif

/// From sums [kBlock][kTile] to the rows of the places that are wanted.
void hand_out(const std::uint16_t* sums, std::size_t first, std::span<const std::uint8_t> lanes,
              std::span<std::uint16_t* const> rows) {
  std::size_t j = 0;
#if defined(__x86_64__)
  while (j + 8 <= lanes.size()) {
    if (lanes[j] % 8 != 0 || lanes[j + 7] != lanes[j] + 7) {  // not eight neighbours
      for (std::size_t k = 0; k < kBlock; ++k) rows[j][first + k] = sums[k * kTile + lanes[j]];
      ++j;
      continue;
    }
    transpose_8x8(sums + lanes[j], rows.data() + j, first);
    transpose_8x8(sums + 8 * kTile + lanes[j], rows.data() + j, first + 8);
    j += 8;
  }
#endif
  for (; j < lanes.size(); ++j)
    for (std::size_t k = 0; k < kBlock; ++k) rows[j][first + k] = sums[k * kTile + lanes[j]];
}

std::vector<Line> tables_of(std::span<const BeamCosts> beams) {
  std::vector<Line> tables(beams.size() * 2);
  for (std::size_t b = 0; b < beams.size(); ++b)
    std::memcpy(tables.data() + 2 * b, beams[b].costs.data(), beams[b].costs.size());
  return tables;
}

}  // namespace

TileScorer::TileScorer(std::span<const BeamCosts> beams, std::size_t headings, std::size_t sectors, std::uint16_t cap,
                       InstructionSet set)
    : set_{set}, tables_{tables_of(beams)} {
  plan_.headings = headings;
  plan_.cap = cap;
  plan_.capped_in_byte = cap == 0 || cap > 255 ? 0 : 255U / cap;
  std::uint8_t most = 1;
  for (const BeamCosts& beam : beams) {
    const std::size_t i = plan_.directions.size();
    const auto sector = [&](std::size_t direction) { return direction * sectors / headings; };
    if (i == 0 || sector(beam.direction) != sector(plan_.directions.back())) plan_.sectors.push_back({i, i});
    plan_.sectors.back().last = i + 1;
    plan_.directions.push_back(static_cast<std::uint32_t>(beam.direction));
    most = std::max(most, *std::max_element(beam.costs.begin(), beam.costs.end()));
  }
  plan_.beams_in_byte = 255U / most;
  const std::size_t blocks = (headings + kBlock - 1) / kBlock;
  if (set == InstructionSet::avx2) {
    by_sixteenths_ = std::make_unique<SixteenthScorer>(plan_, beams);
    sums_.resize(blocks * kBlock * kTile);
  } else {
    tile_.resize(headings + kBlock);
    sums_.resize(kBlock * kTile);
  }
}

TileScorer::~TileScorer() = default;

void TileScorer::load(const std::uint8_t* tile) {
  std::memcpy(tile_.data(), tile, plan_.headings * kTile);
  for (std::size_t i = 0; i < kBlock; ++i)
    std::memcpy(tile_.data() + plan_.headings + i, tile + i % plan_.headings * kTile, kTile);
}

void TileScorer::score_block(std::size_t first, std::size_t count) {
#if defined(__x86_64__)
  if (set_ == InstructionSet::avx512)
    return score_avx512(plan_, tables_.data(), tile_.data(), first, count, sums_.data());
#endif
  score_plain(plan_, tables_.data(), tile_.data(), first, count, sums_.data());
}

void TileScorer::score(const std::uint8_t* tile, std::uint64_t blocks, std::span<const std::uint8_t> lanes,
                       std::span<std::uint16_t* const> rows) {
#if defined(__x86_64__)
  if (by_sixteenths_) return score_by_sixteenths(tile, blocks, lanes, rows);
#endif
  load(tile);
  for (std::size_t first = 0; first < plan_.headings; first += kBlock) {
    if ((blocks >> (first / kBlock) & 1U) == 0) continue;
    score_block(first, std::min(kBlock, plan_.headings - first));
    hand_out(sums_.data(), first, lanes, rows);
  }
}

#if defined(__x86_64__)
/// Blocks that follow each other are scored together: they share the lines that their beams look along.
void TileScorer::score_by_sixteenths(const std::uint8_t* tile, std::uint64_t blocks,
                                     std::span<const std::uint8_t> lanes, std::span<std::uint16_t* const> rows) {
  constexpr std::size_t kHalf = SixteenthScorer::kHalf;
  const std::size_t count = (plan_.headings + kBlock - 1) / kBlock;
  const auto wanted = [&](std::size_t block) { return block < count && (blocks >> block & 1U) != 0; };
  for (std::size_t half = 0; half < 2; ++half) {
    if (std::none_of(lanes.begin(), lanes.end(), [&](std::uint8_t lane) { return lane / kHalf == half; })) continue;
    by_sixteenths_->load(tile, half);
    for (std::size_t block = 0; block < count; ++block) {
      if (!wanted(block)) continue;
      const std::size_t first = block * kBlock;
      while (wanted(block + 1)) ++block;
      const std::size_t end = std::min((block + 1) * kBlock, plan_.headings);
      by_sixteenths_->score(first, end - first, sums_.data() + first * kTile + half * kHalf);
    }
  }
  for (std::size_t block = 0; block < count; ++block)
    if (wanted(block)) hand_out(sums_.data() + block * kBlock * kTile, block * kBlock, lanes, rows);
}
#endif

}  // namespace docent::localization
