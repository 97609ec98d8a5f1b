#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "docent/localization/markov/score_kernel.h"

namespace docent {

/// How AVX2 looks up costs. A shuffle of bytes knows tables of sixteen entries only, so a table of 128 would take
/// eight. But neighbouring places see much the same: what half a line of a tile, 32 places, lets expect lies in two
/// sixteenths of all ranges on average, and the others need no shuffle.
///
/// A line is therefore laid out, once a tile, as one vector of indices for each sixteenth that occurs in it, bit 7 set
/// in all lanes of other sixteenths, where a shuffle then gives 0. And it is taken once for all beams of a sector
/// instead of once a beam: whichever beam looks along it, from whatever heading, finds the indices in registers. A lane
/// counts in one vector only, so sums with saturation come out as those of whole look-ups.
///
/// @pre this processor has AVX2
class SixteenthScorer {
 public:
  static constexpr std::size_t kHalf = 32;  ///< places in a vector

  explicit SixteenthScorer(std::size_t headings);

  /// Lays out places 32 half … 32 half + 31 of a tile. O(headings).
  void load(const std::uint8_t* tile, std::size_t half);

  /// sums[k * kTile + i], as TileScorer defines them, of headings first + k, k < count, in the places that were loaded.
  /// `tables` [2] lines a beam: its costs. O(count * beams). @pre first + count <= headings
  void score(const TileScorer::Plan& plan, const TileScorer::Line* tables, std::size_t first, std::size_t count,
             std::uint16_t* sums);

 private:
  struct Stretch {
    std::uint32_t begin = 0, end = 0;  ///< vectors of a line
  };
  struct Run {
    std::size_t first, count;  ///< headings
  };
  void add_beams(const TileScorer::Plan& plan, const TileScorer::Line* tables, TileScorer::Sector beams, Run run);

  std::size_t headings_;
  std::vector<TileScorer::Line> indices_;  ///< vectors, two a Line
  std::vector<std::uint32_t> offsets_;     ///< of each vector: where its sixteenth begins in a table
  std::vector<Stretch> lines_;             ///< [headings]
  std::vector<TileScorer::Line> part_;     ///< [headings] vectors: the beams of a sector, added up
  std::vector<TileScorer::Line> group_;    ///< [headings] vectors: capped sectors, added up
  std::vector<std::uint16_t> wide_;        ///< [headings][32]: a sector, where bytes do not hold it
};

}  // namespace docent
