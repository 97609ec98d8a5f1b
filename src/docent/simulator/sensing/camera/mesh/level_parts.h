#pragma once

#include <array>
#include <span>
#include <vector>

#include "docent/geometry/polygon.h"

namespace docent::simulator {

/// A rectangle that polygons lie on, cut into what belongs to each: of several over a point the last one owns it, -1
/// where none is. A floor with holes and a ceiling of several heights are both that.
struct LevelParts {
  /// A trapezoid with two sides along y, its corners counter-clockwise.
  struct Piece {
    std::array<Point2, 4> corners;
    int owner = -1;
  };
  /// Where two owners meet.
  struct Border {
    Segment line;
    int left = -1;   ///< owner to the left of the way from line.a to line.b
    int right = -1;  ///< owner to the right
  };
  std::vector<Piece> pieces;
  std::vector<Border> borders;
};

/// The last of the polygons that holds the point; -1: none does.
[[nodiscard]] int owner_at(std::span<const Polygon> polygons, Point2 point);

/// Cuts the rectangle from `low` to `high`. What of a polygon lies outside is left out. O(corners^2 * polygons).
[[nodiscard]] LevelParts level_parts(Point2 low, Point2 high, std::span<const Polygon> polygons);

}  // namespace docent::simulator
