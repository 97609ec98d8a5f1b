#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/check.h"
#include "docent/pictures/colors.h"

namespace docent::pictures {

/// RGBA pixels. Pixel (0, 0) is at the top left, x to the right, y down; its centre lies at (0.5, 0.5).
class Image {
 public:
  /// @pre 0 < width, height <= 16384
  Image(int width, int height, Color background = colors::kWhite);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }  ///< [height][width][4], RGBA
  [[nodiscard]] std::span<std::uint8_t> writable_bytes() { return bytes_; }     ///< likewise
  [[nodiscard]] bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  /// @pre holds(x, y)
  [[nodiscard]] Color at(int x, int y) const {
    DOCENT_CHECK(holds(x, y));
    const std::uint8_t* pixel = &bytes_[index(x, y)];
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
  }
  /// Outside: nothing.
  void set(int x, int y, Color color) {
    if (!holds(x, y)) return;
    std::uint8_t* pixel = &bytes_[index(x, y)];
    pixel[0] = color.red;
    pixel[1] = color.green;
    pixel[2] = color.blue;
    pixel[3] = color.alpha;
  }
  /// Lays `color` over the pixel; `coverage` 0..1 is the part of the pixel that the shape covers. Outside: nothing.
  void blend(int x, int y, Color color, double coverage = 1.0);

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }

  int width_;
  int height_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace docent::pictures
