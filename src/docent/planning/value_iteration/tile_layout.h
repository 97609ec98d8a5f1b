#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "docent/planning/value_iteration/tile_kernel.h"

namespace docent::planning {

/// A step from one cell to a neighbour; `length` in cells.
struct GridStep {
  int column;
  int row;
  float length;
};
inline constexpr std::array<GridStep, 8> kGridSteps{{{1, 0, 1.0F},
                                                     {0, 1, 1.0F},
                                                     {-1, 0, 1.0F},
                                                     {0, -1, 1.0F},
                                                     {1, 1, kDiagonalStep},
                                                     {-1, 1, kDiagonalStep},
                                                     {-1, -1, kDiagonalStep},
                                                     {1, -1, kDiagonalStep}}};

inline constexpr std::uint64_t kAllLines = ~std::uint64_t{0} >> (64 - kTileSide);  ///< of a tile, a bit each
inline constexpr int kLastLine = kTileSide - 1;

}  // namespace docent::planning
