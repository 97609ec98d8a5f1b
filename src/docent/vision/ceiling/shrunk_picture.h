#pragma once

#include <cstddef>
#include <vector>

#include "docent/vision/ceiling/ceiling_camera.h"

namespace docent::vision {

/// A picture whose pixels are the means of blocks of another: a level of a pyramid.
class ShrunkPicture {
 public:
  /// @param block  [pixels] side of a block, > 0
  ShrunkPicture(const GrayPicture& picture, int block);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int block() const { return block_; }
  [[nodiscard]] float at(int column, int row) const {
    return values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column)];
  }
  /// Of the whole picture: the middle of a block. The middle of the first pixel is 0.
  [[nodiscard]] double middle(int index) const { return index * block_ + 0.5 * (block_ - 1); }

  struct Value {
    double brightness = 0.0;  ///< 0 .. 1
    double by_x = 0.0;        ///< [1/pixel of the whole picture]
    double by_y = 0.0;        ///< [1/pixel of the whole picture]
  };
  /// Between blocks; false outside. @param x, y  [pixels of the whole picture]
  [[nodiscard]] bool look(double x, double y, Value& value) const {
    const double u = (x - 0.5 * (block_ - 1)) * scale_, v = (y - 0.5 * (block_ - 1)) * scale_;
    if (!(u >= 0.0 && v >= 0.0 && u < columns_ - 1 && v < rows_ - 1)) return false;  // NaN neither
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const double s = u - column, t = v - row;
    const float* cell =
        &values_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
    const double a = static_cast<double>(cell[0]), b = static_cast<double>(cell[1]);
    const double c = static_cast<double>(cell[columns_]), d = static_cast<double>(cell[columns_ + 1]);
    value.brightness = (1.0 - t) * ((1.0 - s) * a + s * b) + t * ((1.0 - s) * c + s * d);
    value.by_x = scale_ * ((1.0 - t) * (b - a) + t * (d - c));
    value.by_y = scale_ * ((1.0 - s) * (c - a) + s * (d - b));
    return true;
  }

 private:
  int block_;
  int columns_;
  int rows_;
  double scale_;
  std::vector<float> values_;
};

}  // namespace docent::vision
