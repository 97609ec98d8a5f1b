#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "docent/base/aligned_vector.h"
#include "docent/base/instruction_set.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent::localization {

class SixteenthScorer;

/// What a beam costs at each expected range: how far ln P(d | o), tempered, stays below its best, in steps of
/// 1 / kCostPerNat. Whole numbers, so that every instruction set gives the same belief, bit for bit.
struct BeamCosts {
  std::array<std::uint8_t, sensor_models::kExpectedRanges> costs{};  ///< each <= kMaxCost, so that two add up in a byte
  std::size_t direction = 0;                                         ///< 0..headings-1
};
inline constexpr int kMaxCost = 127;
inline constexpr double kCostPerNat = 32.0;

/// The costs of all beams of a scan in the places of a tile: for each heading h of some blocks, the sum over sectors of
/// min(cap, sum over the sector's beams of costs[tile[(h + direction) % headings][place]]). Made once a scan.
///
/// Sums stay in bytes as long as they can: a sector whose cap fits in a byte is summed with saturation, and as many
/// capped sectors as fit are added up before anything is widened. That is exact.
class TileScorer {
 public:
  static constexpr std::size_t kBlock = 16;  ///< headings that are scored together

  /// Sector of a beam: direction * sectors / headings. `cap` in cost steps.
  /// @pre beams in the order of directions; beams.size() * kMaxCost < 65536; directions < headings
  TileScorer(std::span<const BeamCosts> beams, std::size_t headings, std::size_t sectors, std::uint16_t cap,
             InstructionSet set);
  ~TileScorer();
  TileScorer(const TileScorer&) = delete;
  TileScorer& operator=(const TileScorer&) = delete;

  /// Scores the blocks whose bits are set in `blocks`, block i being the headings from i * kBlock on, and writes
  /// costs[place][i * kBlock + k] for the places of `lanes` (ascending, 0..63). What lies in a last block beyond the
  /// headings is undefined. `rows[j]`: where the costs of lanes[j] go; a multiple of kBlock wide.
  void score(const std::uint8_t* tile, std::uint64_t blocks, std::span<const std::uint8_t> lanes,
             std::span<std::uint16_t* const> rows);

  /// A run of beams whose costs are added up before the cap. Public for the kernels.
  struct Sector {
    std::size_t first = 0, last = 0;
  };
  struct Plan {
    std::size_t headings = 0;
    std::uint16_t cap = 0;
    std::size_t capped_in_byte = 0;  ///< sectors that add up in a byte; 0: the cap needs 16 bits
    std::size_t beams_in_byte = 1;   ///< whose costs add up in a byte, whatever they see
    std::vector<Sector> sectors;
    std::vector<std::uint32_t> directions;  ///< ascending
  };
  struct alignas(64) Line {
    std::array<std::uint8_t, 64> bytes;
  };

 private:
  void load(const std::uint8_t* tile);
  void score_block(std::size_t first, std::size_t count);
  void score_by_sixteenths(const std::uint8_t* tile, std::uint64_t blocks, std::span<const std::uint8_t> lanes,
                           std::span<std::uint16_t* const> rows);

  InstructionSet set_;
  Plan plan_;
  std::vector<Line> tables_;                        ///< [2] a beam: its costs
  std::vector<Line> tile_;                          ///< the tile, its first block of directions once more at the end
  AlignedVector<std::uint16_t> sums_;               ///< [headings][kTile], of a block or of all
  std::unique_ptr<SixteenthScorer> by_sixteenths_;  ///< for AVX2
};

}  // namespace docent::localization
