#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/localization/markov/score_kernel.h"

namespace docent::localization {

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
  struct alignas(32) Vector {
    std::array<std::uint8_t, kHalf> bytes;
  };

  /// `beams` are those of the plan, which must outlive the scorer.
  SixteenthScorer(const TileScorer::Plan& plan, std::span<const BeamCosts> beams);

  /// Lays out places 32 half … 32 half + 31 of a tile. O(headings).
  void load(const std::uint8_t* tile, std::size_t half);

  /// sums[k * kTile + i], as TileScorer defines them, of headings first + k, k < count, in the places that were loaded.
  /// O(count * beams). @pre first + count <= headings
  void score(std::size_t first, std::size_t count, std::uint16_t* sums);

 private:
  /// What the innermost loop wants of a beam, side by side.
  struct alignas(16) Beam {
    std::array<std::uint8_t, sensor_models::kExpectedRanges> costs;
    std::int32_t back;  ///< vectors of sums from the line that is seen to the heading that sees it, in bytes: < 0
  };
  /// Vectors that are looked up together: all of a line, or four of more. Pieces of one length make a list, so that the
  /// loop over them takes no turn that a processor cannot foresee.
  static constexpr std::size_t kLongest = 4;
  struct Piece {
    std::uint32_t first;  ///< vector
    std::uint32_t line;
  };
  using Ends = std::array<std::uint16_t, kLongest>;  ///< of the lists, each by length - 1
  struct Run {
    std::size_t first, count;  ///< headings
  };
  struct Span {
    std::size_t begin, end;
  };
  /// [run.count]: the sums of the beams, saturated. In part_.
  const Vector* add_beams(TileScorer::Sector beams, Run run);
  const Vector* add_all_round(TileScorer::Sector beams);
  void add_lines(TileScorer::Sector beams, Span lines, Vector* sums);
  template <std::size_t kLength>
  void add_pieces(TileScorer::Sector beams, Span pieces, Vector* sums);

  const TileScorer::Plan* plan_;
  std::vector<Beam> beams_;
  std::vector<Vector> indices_;
  std::vector<std::uint32_t> offsets_;  ///< of each vector: where its sixteenth begins in a table
  std::array<std::vector<Piece>, kLongest> pieces_;
  std::vector<Ends> begins_;         ///< [headings + 1]: where the pieces of a line begin in the lists
  std::vector<Vector> part_;         ///< the beams of a sector, added up: headings, with room before and behind
  std::vector<Vector> group_;        ///< [headings]: capped sectors, added up
  std::vector<std::uint16_t> wide_;  ///< [headings][32]: a sector, where bytes do not hold it
};

}  // namespace docent::localization
