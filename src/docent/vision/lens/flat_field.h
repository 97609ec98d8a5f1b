#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/vision/lens/lens.h"

namespace docent::vision {

/// How much light a lens loses towards the picture's rim, as many pictures of one camera show it: on the average they
/// are equally bright everywhere.
struct FlatField {
  double centre_x = 0.0;  ///< [pixels]
  double centre_y = 0.0;  ///< [pixels]
  double half = 1.0;      ///< [pixels] half of the picture's diagonal
  double square = 0.0;    ///< light at a distance r [half]: 1 + square r^2 + fourth r^4
  double fourth = 0.0;
  [[nodiscard]] double at(double column, double row) const;
};

/// Of grey pictures of a lens, rows from the top, each of as many bytes as it has pixels: by the middle one of what
/// each pixel shows as a share of its picture's mean; pictures that are burnt out in part do not count. Few pictures
/// (below 30) tell nothing: flat. O(pixels).
[[nodiscard]] FlatField flat_field_of(std::span<const std::span<const std::uint8_t>> pictures, const Lens& lens);

/// A picture of `columns` [pixels] without the loss, by darkening its middle, so that nothing is cut off above; 255,
/// burnt out, stays.
[[nodiscard]] std::vector<std::uint8_t> flattened(std::span<const std::uint8_t> picture, int columns,
                                                  const FlatField& field);

}  // namespace docent::vision
