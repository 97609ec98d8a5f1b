#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "docent/base/instruction_set.h"

namespace docent::planning {

/// Value iteration works on square tiles of the grid, [kTileSide][kTileSide] floats each, row by row, aligned to 64
/// bytes: a tile's values and costs stay in the first caches until nothing changes in it.
inline constexpr int kTileSide = 32;
inline constexpr std::size_t kTileCells = static_cast<std::size_t>(kTileSide) * kTileSide;

inline constexpr float kUnreached = std::numeric_limits<float>::infinity();
inline constexpr float kDiagonalStep = std::numbers::sqrt2_v<float>;

/// What a pass changed: a bit a line, a bit a place along the line.
struct TileChanges {
  std::uint64_t lines = 0;
  std::uint64_t lanes = 0;
  std::uint64_t looked_at = 0;  ///< lines
};

/// What the cells of one line offer to those of the line beside it: V + cost straight ahead, V + cost * sqrt 2 aslant.
/// Everything here is made of such offers and of minima, each computed the same way wherever it is computed, so the
/// values that come out do not depend on the order of work and all instruction sets agree bit for bit.
///
/// An offer is *firm* if it is greater than the value that it is made of: what a sum rounds away must not let two
/// cells hold each other up.
struct TileKernels {
  /// Lowers lines of the tile by the offers of the line before, one after the other: from the first on, or `backwards`
  /// from the last. It looks at `lines` and at whatever comes behind a line that fell. @returns what fell
  TileChanges (*sweep)(float* values, const float* costs, bool backwards, std::uint64_t lines);
  /// The selective reset, in the same orders: a value in `lines` that is less than all firm offers of its eight
  /// neighbours and than `support` (what holds it from outside the tile, or for being a goal) becomes that of `goals`
  /// (infinite where there is none). `lines` are then those that must be looked at once more. @returns what was reset
  TileChanges (*reset)(float* values, const float* costs, const float* support, const float* goals, bool backwards,
                       std::uint64_t& lines);
  /// Rows become columns.
  void (*transpose)(const float* from, float* to);
  /// The offers that a line of cells makes to the line beside it, [kTileSide]; without those from beyond its ends.
  void (*offers)(const float* values, const float* costs, bool firm, float* out);
  /// The least of `offers` that are below `values`; infinite if none is.
  float (*least_gain)(const float* offers, const float* values);
};

[[nodiscard]] const TileKernels& tile_kernels(InstructionSet set);

}  // namespace docent::planning
