#include "docent/localization/markov/score_kernel.h"

#include <algorithm>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // gcc 12's own AVX-512 header sets it off
#endif
#endif

namespace docent {

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
        for (std::size_t i = 0; i < kTile; ++i) part[i] += costs[seen[i]];
      }
      for (std::size_t i = 0; i < kTile; ++i)
        out[i] = static_cast<std::uint16_t>(out[i] + std::min<std::uint32_t>(part[i], plan.cap));
    }
  }
}

#if defined(__x86_64__)

#define DOCENT_AVX2 __attribute__((target("avx2")))
#define DOCENT_AVX512 __attribute__((target("avx512f,avx512bw,avx512dq,avx512vl,avx512vbmi")))
#define DOCENT_INLINE __attribute__((always_inline)) inline

/// AVX2 looks up 128 entries by eight shuffles of 16. A shuffle gives zero where bit 7 of its index is set, so with the
/// index less 16 t, shuffle t counts wherever the index is at least 16 t. The tables therefore hold differences (by
/// exclusive or) of successive sixteenths, and the result is the exclusive or of all eight. The shifted indices of a
/// line serve all beams and headings: they are laid out once a tile, every second one, the others being a
/// subtraction away: [half][directions + kBlock][kStored][32].
constexpr std::size_t kShifts = 8;
constexpr std::size_t kStored = 4;
constexpr std::size_t kHalf = 32;

DOCENT_AVX2 void shift_tile(const std::uint8_t* tile, std::size_t headings, Line* out) {
  const __m256i step = _mm256_set1_epi8(16 * kShifts / kStored);
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t line = 0; line < headings + kBlock; ++line) {
      const std::size_t from = line % headings;
      auto* const to = reinterpret_cast<__m256i*>(out + (half * (headings + kBlock) + line) * kStored / 2);
      __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(tile + from * kTile + half * kHalf));
      for (std::size_t i = 0; i < kStored; ++i) {
        _mm256_store_si256(to + i, index);
        index = _mm256_sub_epi8(index, step);
      }
    }
  }
}

struct Avx2Tables {
  __m256i sixteenths[kShifts];
};
DOCENT_AVX2 DOCENT_INLINE void load_avx2(const Line* tables, std::size_t beam, Avx2Tables& out) {
  const auto* const from = reinterpret_cast<const __m256i*>(tables + beam * kShifts / 2);
  for (std::size_t shift = 0; shift < kShifts; ++shift) out.sixteenths[shift] = _mm256_load_si256(from + shift);
}
DOCENT_AVX2 DOCENT_INLINE void look_up_avx2(const Avx2Tables& tables, const __m256i* indices, const __m256i& sixteen,
                                            __m256i& cost) {
  __m256i part[kStored];
  for (std::size_t i = 0; i < kStored; ++i) {
    const __m256i index = _mm256_load_si256(indices + i);
    part[i] = _mm256_xor_si256(_mm256_shuffle_epi8(tables.sixteenths[2 * i], index),
                               _mm256_shuffle_epi8(tables.sixteenths[2 * i + 1], _mm256_sub_epi8(index, sixteen)));
  }
  cost = _mm256_xor_si256(_mm256_xor_si256(part[0], part[1]), _mm256_xor_si256(part[2], part[3]));
}
DOCENT_AVX2 DOCENT_INLINE void widen_avx2(const __m256i& bytes, std::uint16_t* sums, std::uint16_t cap) {
  const __m256i most = _mm256_set1_epi16(static_cast<short>(cap));
  auto* const out = reinterpret_cast<__m256i*>(sums);
  const __m256i low = _mm256_cvtepu8_epi16(_mm256_castsi256_si128(bytes));
  const __m256i high = _mm256_cvtepu8_epi16(_mm256_extracti128_si256(bytes, 1));
  _mm256_storeu_si256(out, _mm256_min_epu16(most, _mm256_add_epi16(_mm256_loadu_si256(out), low)));
  _mm256_storeu_si256(out + 1, _mm256_min_epu16(most, _mm256_add_epi16(_mm256_loadu_si256(out + 1), high)));
}

/// Half a tile. `part` [count] gets the sums of the beams, saturated.
DOCENT_AVX2 void add_beams_avx2(const Plan& plan, const Line* tables, const Line* half_tile, TileScorer::Sector beams,
                                std::size_t first, std::size_t count, __m256i* part) {
  const __m256i sixteen = _mm256_set1_epi8(16);
  for (std::size_t k = 0; k < count; ++k) part[k] = _mm256_setzero_si256();
  for (std::size_t beam = beams.first; beam < beams.last; ++beam) {
    Avx2Tables table;
    load_avx2(tables, beam, table);
    const auto* indices = reinterpret_cast<const __m256i*>(half_tile + first_line(plan, beam, first) * kStored / 2);
    for (std::size_t k = 0; k < count; ++k, indices += kStored) {
      __m256i cost;
      look_up_avx2(table, indices, sixteen, cost);
      part[k] = _mm256_adds_epu8(part[k], cost);
    }
  }
}

DOCENT_AVX2 void score_avx2(const Plan& plan, const Line* tables, const Line* tile, std::size_t first,
                            std::size_t count, std::uint16_t* sums) {
  __m256i part[kBlock];
  __m256i group[kBlock];
  std::array<std::uint16_t, kBlock * kHalf> wide;
  std::fill_n(sums, count * kTile, std::uint16_t{0});
  for (std::size_t half = 0; half < 2; ++half) {
    const Line* const half_tile = tile + half * (plan.headings + kBlock) * kStored / 2;
    std::uint16_t* const out = sums + half * kHalf;
    const auto flush = [&]() DOCENT_AVX2 {
      for (std::size_t k = 0; k < count; ++k) {
        widen_avx2(group[k], out + k * kTile, 0xffff);
        group[k] = _mm256_setzero_si256();
      }
    };
    if (plan.capped_in_byte > 0) {
      const __m256i cap = _mm256_set1_epi8(static_cast<char>(plan.cap));
      for (std::size_t k = 0; k < count; ++k) group[k] = _mm256_setzero_si256();
      for (std::size_t s = 0; s < plan.sectors.size(); ++s) {
        add_beams_avx2(plan, tables, half_tile, plan.sectors[s], first, count, part);
        for (std::size_t k = 0; k < count; ++k) group[k] = _mm256_add_epi8(group[k], _mm256_min_epu8(part[k], cap));
        if ((s + 1) % plan.capped_in_byte == 0) flush();
      }
      flush();
      continue;
    }
    for (const TileScorer::Sector& sector : plan.sectors) {
      wide.fill(0);
      for (std::size_t beam = sector.first; beam < sector.last; beam += 2) {  // two costs fit in a byte
        add_beams_avx2(plan, tables, half_tile, {beam, std::min(beam + 2, sector.last)}, first, count, part);
        for (std::size_t k = 0; k < count; ++k) widen_avx2(part[k], wide.data() + k * kHalf, plan.cap);
      }
      for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < kHalf; ++i)
          out[k * kTile + i] = static_cast<std::uint16_t>(out[k * kTile + i] + wide[k * kHalf + i]);
    }
  }
}

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
    for (std::size_t beam = sector.first; beam < sector.last; beam += 2) {  // two costs fit in a byte
      add_beams_avx512<kCount>(plan, tables, tile, {beam, std::min(beam + 2, sector.last)}, first, part);
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

std::vector<Line> tables_of(std::span<const BeamCosts> beams, InstructionSet set) {
  std::vector<Line> tables(beams.size() * (set == InstructionSet::avx2 ? 4 : 2));
  for (std::size_t b = 0; b < beams.size(); ++b) {
    const auto& costs = beams[b].costs;
    if (set != InstructionSet::avx2) {
      std::memcpy(tables.data() + 2 * b, costs.data(), costs.size());
      continue;
    }
    auto* out = reinterpret_cast<std::uint8_t*>(tables.data() + 4 * b);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const auto value = static_cast<std::uint8_t>(i < 16 ? costs[i] : costs[i] ^ costs[i - 16]);
      out[i / 16 * 32 + i % 16] = out[i / 16 * 32 + 16 + i % 16] = value;
    }
  }
  return tables;
}

}  // namespace

TileScorer::TileScorer(std::span<const BeamCosts> beams, std::size_t headings, std::size_t sectors, std::uint16_t cap,
                       InstructionSet set)
    : set_{set}, tables_{tables_of(beams, set)} {
  plan_.headings = headings;
  plan_.cap = cap;
  plan_.capped_in_byte = cap == 0 || cap > 255 ? 0 : 255U / cap;
  for (const BeamCosts& beam : beams) {
    const std::size_t i = plan_.directions.size();
    const auto sector = [&](std::size_t direction) { return direction * sectors / headings; };
    if (i == 0 || sector(beam.direction) != sector(plan_.directions.back())) plan_.sectors.push_back({i, i});
    plan_.sectors.back().last = i + 1;
    plan_.directions.push_back(beam.direction);
  }
  tile_.resize((headings + kBlock) * (set == InstructionSet::avx2 ? 4 : 1));
}

void TileScorer::load(const std::uint8_t* tile) {
#if defined(__x86_64__)
  if (set_ == InstructionSet::avx2) return shift_tile(tile, plan_.headings, tile_.data());
#endif
  std::memcpy(tile_.data(), tile, plan_.headings * kTile);
  for (std::size_t i = 0; i < kBlock; ++i)
    std::memcpy(tile_.data() + plan_.headings + i, tile + i % plan_.headings * kTile, kTile);
}

void TileScorer::score_block(std::size_t first, std::size_t count, std::uint16_t* sums) {
#if defined(__x86_64__)
  if (set_ == InstructionSet::avx512) return score_avx512(plan_, tables_.data(), tile_.data(), first, count, sums);
  if (set_ == InstructionSet::avx2) return score_avx2(plan_, tables_.data(), tile_.data(), first, count, sums);
#endif
  score_plain(plan_, tables_.data(), tile_.data(), first, count, sums);
}

void TileScorer::score(const std::uint8_t* tile, std::uint64_t blocks, std::span<const std::uint8_t> lanes,
                       std::span<std::uint16_t* const> rows) {
  load(tile);
  alignas(64) std::array<std::uint16_t, kBlock * kTile> sums{};
  for (std::size_t first = 0; first < plan_.headings; first += kBlock) {
    if ((blocks >> (first / kBlock) & 1U) == 0) continue;
    score_block(first, std::min(kBlock, plan_.headings - first), sums.data());
    hand_out(sums.data(), first, lanes, rows);
  }
}

}  // namespace docent
