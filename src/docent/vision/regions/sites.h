#pragma once

#include <cstddef>
#include <vector>

#include "docent/pictures/image.h"

namespace docent::vision {

/// The mean colour of a block of pixels: how light it is, and two opponent colours that are 0 where it is grey.
struct Site {
  float luminance = 0.0F;    ///< 0..255
  float red_green = 0.0F;    ///< -255..255, red is positive
  float yellow_blue = 0.0F;  ///< -255..255, yellow is positive
};

/// A picture after its low-pass filter and subsampling, the first stage of [Buhmann1995].
struct Sites {
  int columns = 0;
  int rows = 0;
  int block = 1;            ///< [pixels] side of a site's block
  std::vector<Site> cells;  ///< [rows * columns] from the top left

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// The picture in blocks of `block` pixels; what is left at the right and below is left out. O(pixels).
/// @pre 1 <= block <= the shorter side of the picture
[[nodiscard]] Sites sites_of(const pictures::Image& picture, int block);

}  // namespace docent::vision
