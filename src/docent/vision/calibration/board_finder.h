#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::vision {

/// A checkerboard for calibrations: its inner corners, where four squares meet.
struct Board {
  int columns = 9;  ///< >= 3 corners in a row
  int rows = 6;     ///< >= 3 corners in a column, another number: a board that is the same turned round tells less
  double square = 0.025;  ///< [m] > 0 side of a square
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] std::size_t corners() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

/// What was seen of a board in one picture.
struct BoardView {
  std::string name;                      ///< of the picture
  std::vector<Eigen::Vector2d> corners;  ///< [pixels] row after row, the centre of the first pixel is 0
};

/// The board's corners in a grey picture, to some hundredths of a pixel; nullopt: they are not all there. By OpenCV's
/// search for squares. Deterministic.
/// @param grey  [rows * columns] from the top
[[nodiscard]] std::optional<std::vector<Eigen::Vector2d>> find_board(std::span<const std::uint8_t> grey, int columns,
                                                                     int rows, const Board& board);

}  // namespace docent::vision
