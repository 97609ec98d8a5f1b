#include "docent/localization/markov/score_by_sixteenths.h"

#include <algorithm>

#include "docent/base/kernel_targets.h"

namespace docent::localization {

namespace {

constexpr std::size_t kTilePlaces = RangeTable::kTile;
constexpr std::size_t kNear = 8;  // directions: beams that take their lines together
constexpr std::size_t kSixteenths = sensor_models::kExpectedRanges / 16;

}  // namespace

SixteenthScorer::SixteenthScorer(const TileScorer::Plan& plan, std::span<const BeamCosts> beams)
    : plan_{&plan},
      indices_(plan.headings * kSixteenths + 1),
      offsets_(plan.headings * kSixteenths + 1),
      begins_(plan.headings + 1),
      part_(2 * (plan.headings + kNear)),
      group_(plan.headings),
      wide_(plan.headings * kHalf) {
  for (auto& list : pieces_) list.resize(2 * plan.headings + 1);
  for (const BeamCosts& beam : beams)
    beams_.push_back({beam.costs, -static_cast<std::int32_t>(beam.direction * sizeof(Vector))});
}

#if defined(__x86_64__)

#define DOCENT_INLINE __attribute__((always_inline)) inline

namespace {

using Vector = SixteenthScorer::Vector;

DOCENT_AVX2 DOCENT_INLINE __m256i load_vector(const Vector& from) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(&from));
}
DOCENT_AVX2 DOCENT_INLINE void store_vector(Vector& to, const __m256i& value) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(&to), value);
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
  std::uint32_t next = 0;
  Ends ends{};
  for (std::size_t line = 0; line < plan_->headings; ++line) {
    const __m256i index = _mm256_load_si256(reinterpret_cast<const __m256i*>(tile + line * kTilePlaces + half * kHalf));
    const std::uint32_t first = next;
    for (std::size_t sixteenth = 0; sixteenth < kSixteenths; ++sixteenth) {
      // 0..15 in the lanes of this sixteenth and 16..127 in others; bit 7 of those follows by an addition.
      const __m256i start = _mm256_set1_epi8(static_cast<char>(16 * sixteenth));
      const __m256i vector = _mm256_adds_epu8(_mm256_xor_si256(index, start), others);
      store_vector(indices_[next], vector);
      offsets_[next] = static_cast<std::uint32_t>(16 * sixteenth);
      next += _mm256_movemask_epi8(vector) != -1 ? 1U : 0U;  // written anyway: no branch
    }
    begins_[line] = ends;
    const std::size_t count = next - first;
    // At most eight: four and a rest. Both are written anyway, too.
    const std::size_t rest = (count - 1) % kLongest;
    pieces_[rest][ends[rest]++] = {first, static_cast<std::uint32_t>(line)};
    pieces_[kLongest - 1][ends[kLongest - 1]] = {first + static_cast<std::uint32_t>(rest) + 1,
                                                 static_cast<std::uint32_t>(line)};
    ends[kLongest - 1] = static_cast<std::uint16_t>(ends[kLongest - 1] + (count > kLongest ? 1 : 0));
  }
  begins_[plan_->headings] = ends;
}

/// sums[line - direction] += costs.
template <std::size_t kLength>
DOCENT_AVX2 DOCENT_INLINE void SixteenthScorer::add_pieces(TileScorer::Sector beams, Span pieces, Vector* sums) {
  const Beam* const begin = beams_.data() + beams.first;
  const Beam* const end = beams_.data() + beams.last;
  for (std::size_t i = pieces.begin; i < pieces.end; ++i) {
    const Piece piece = pieces_[kLength - 1][i];
    __m256i index[kLength];
    std::size_t offset[kLength];
    for (std::size_t v = 0; v < kLength; ++v) {
      index[v] = load_vector(indices_[piece.first + v]);
      offset[v] = offsets_[piece.first + v];
    }
    auto* const at = reinterpret_cast<std::uint8_t*>(sums + piece.line);
#pragma GCC unroll 4
    for (const Beam* beam = begin; beam != end; ++beam) {
      __m256i cost = _mm256_setzero_si256();
      for (std::size_t v = 0; v < kLength; ++v) {
        const __m128i costs = _mm_load_si128(reinterpret_cast<const __m128i*>(beam->costs.data() + offset[v]));
        const __m256i found = _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(costs), index[v]);
        cost = v == 0 ? found : _mm256_or_si256(cost, found);
      }
      auto* const sum = reinterpret_cast<__m256i*>(at + beam->back);
      _mm256_store_si256(sum, _mm256_adds_epu8(_mm256_load_si256(sum), cost));
    }
  }
}

/// The same of all pieces of these lines.
DOCENT_AVX2 void SixteenthScorer::add_lines(TileScorer::Sector beams, Span lines, Vector* sums) {
  const Ends& begin = begins_[lines.begin];
  const Ends& end = begins_[lines.end];
  add_pieces<1>(beams, {begin[0], end[0]}, sums);
  add_pieces<2>(beams, {begin[1], end[1]}, sums);
  add_pieces<3>(beams, {begin[2], end[2]}, sums);
  add_pieces<4>(beams, {begin[3], end[3]}, sums);
}

/// Of all headings: every line once, for all beams. What headings less than 0 get belongs to the last ones.
DOCENT_AVX2 const Vector* SixteenthScorer::add_all_round(TileScorer::Sector beams) {
  const std::size_t headings = plan_->headings;
  const std::size_t nearest = plan_->directions[beams.first];
  const std::size_t span = plan_->directions[beams.last - 1] - nearest;
  std::fill_n(part_.begin(), headings + span, Vector{});
  Vector* const sums = part_.data() + span;
  add_lines(beams, {nearest, headings}, sums);
  add_lines(beams, {0, nearest}, sums + headings);
  for (std::size_t i = 0; i < span; ++i)
    store_vector(part_[headings + i], _mm256_adds_epu8(load_vector(part_[headings + i]), load_vector(part_[i])));
  return sums;
}

/// Beams that look nearly the same way take all lines that any of them needs; what some of them thus add to headings
/// before and behind the run goes to waste, which is cheaper than to look where each begins and ends.
DOCENT_AVX2 const Vector* SixteenthScorer::add_beams(TileScorer::Sector beams, Run run) {
  const std::size_t headings = plan_->headings;
  if (run.count == headings) return add_all_round(beams);
  std::fill_n(part_.begin(), run.count + 2 * kNear, Vector{});
  Vector* const sums = part_.data() + kNear;
  const std::uint32_t* const directions = plan_->directions.data();
  for (std::size_t beam = beams.first; beam < beams.last;) {
    TileScorer::Sector near{beam, beam + 1};
    while (near.last < beams.last && directions[near.last] < directions[beam] + kNear) ++near.last;
    // A line is where heading + direction leads.
    const std::size_t begin = run.first + directions[beam];
    const std::size_t end = run.first + run.count + directions[near.last - 1];
    if (begin < headings) add_lines(near, {begin, std::min(end, headings)}, sums - run.first);
    const std::size_t from = std::max(begin, headings) - headings;
    if (end > headings) add_lines(near, {from, std::min(end - headings, headings)}, sums + headings - run.first);
    beam = near.last;
  }
  return sums;
}

DOCENT_AVX2 void SixteenthScorer::score(std::size_t first, std::size_t count, std::uint16_t* sums) {
  for (std::size_t k = 0; k < count; ++k) std::fill_n(sums + k * kTilePlaces, kHalf, std::uint16_t{0});
  const auto& sectors = plan_->sectors;
  if (plan_->capped_in_byte > 0) {
    const __m256i cap = _mm256_set1_epi8(static_cast<char>(plan_->cap));
    std::fill_n(group_.begin(), count, Vector{});
    for (std::size_t s = 0; s < sectors.size(); ++s) {
      const Vector* const part = add_beams(sectors[s], {first, count});
      for (std::size_t k = 0; k < count; ++k)
        store_vector(group_[k], _mm256_add_epi8(load_vector(group_[k]), _mm256_min_epu8(load_vector(part[k]), cap)));
      if ((s + 1) % plan_->capped_in_byte != 0 && s + 1 < sectors.size()) continue;
      for (std::size_t k = 0; k < count; ++k) {
        widen(load_vector(group_[k]), sums + k * kTilePlaces);
        group_[k] = {};
      }
    }
    return;
  }
  for (const TileScorer::Sector& sector : sectors) {
    std::fill_n(wide_.begin(), count * kHalf, std::uint16_t{0});
    for (std::size_t beam = sector.first; beam < sector.last; beam += plan_->beams_in_byte) {
      const TileScorer::Sector some{beam, std::min(beam + plan_->beams_in_byte, sector.last)};
      const Vector* const part = add_beams(some, {first, count});
      for (std::size_t k = 0; k < count; ++k) widen(load_vector(part[k]), wide_.data() + k * kHalf);
    }
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < kHalf; ++i)
        sums[k * kTilePlaces + i] =
            static_cast<std::uint16_t>(sums[k * kTilePlaces + i] + std::min(wide_[k * kHalf + i], plan_->cap));
  }
}

#endif

}  // namespace docent::localization
