#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

  [[nodiscard]] Color at(int x, int y) const;  ///< @pre holds(x, y)
  void set(int x, int y, Color color);         ///< outside: nothing
  /// Lays `color` over the pixel; `coverage` 0..1 is the part of the pixel that the shape covers. Outside: nothing.
  void blend(int x, int y, Color color, double coverage = 1.0);

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace docent::pictures
