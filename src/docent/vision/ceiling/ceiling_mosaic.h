#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "docent/grid/occupancy_grid.h"

namespace docent::vision {

/// What the ceiling of a hall looks like from below, each part at its own height.
struct CeilingMosaic {
  static constexpr std::uint8_t kUnknown = 255;  ///< no part: no picture showed it

  GridFrame frame;                 ///< map
  std::vector<double> heights;     ///< [m] above the floor, of each part; fewer than kUnknown
  std::vector<std::uint8_t> part;  ///< [rows * columns] which of `heights`, or kUnknown
  std::vector<float> brightness;   ///< [rows * columns] 0 .. 1
  bool is_cut_short = false;       ///< whoever made it ended early: heights and places are not yet as good as they get
};

/// Whether no lower part hides a place of the ceiling from a lens. O(parts).
/// @param lens_height  [m] above the floor
[[nodiscard]] bool is_visible(const CeilingMosaic& mosaic, Point2 lens_in_map, double lens_height, Point2 in_map,
                              std::size_t part);

/// A mosaic that was blurred, ready to be looked up: brightness and its slopes. Its cells are as long as the blur
/// allows.
class MosaicLevel {
 public:
  /// @param blur  [m] standard deviation, about; parts are blurred each for itself
  MosaicLevel(const CeilingMosaic& mosaic, double blur);

  struct Look {
    float brightness = 0.0F;
    float by_x = 0.0F;  ///< [1/m] d brightness / d x, map
    float by_y = 0.0F;  ///< [1/m]
  };
  [[nodiscard]] const std::vector<double>& heights() const { return heights_; }
  [[nodiscard]] const GridFrame& frame() const { return frame_; }
  [[nodiscard]] double blur() const { return blur_; }

  /// Of the cell at a place that is given in cells from the frame's origin; false where it is not known or of another
  /// part.
  [[nodiscard]] bool nearest(float column, float row, std::size_t part, float& brightness) const {
    if (!(column >= 0.0F && row >= 0.0F && column < static_cast<float>(frame_.columns - 1) &&
          row < static_cast<float>(frame_.rows - 1)))
      return false;
    const std::size_t at = static_cast<std::size_t>(static_cast<int>(row)) * static_cast<std::size_t>(frame_.columns) +
                           static_cast<std::size_t>(static_cast<int>(column));
    brightness = cells_[at].brightness;
    return whole_[at] == part;
  }

  /// Between cells; false where one of the four around is not known or of another part.
  [[nodiscard]] bool look(Point2 in_map, std::size_t part, Look& look) const {
    const double x = (in_map.x - frame_.origin.x) * per_metre_ - 0.5;
    const double y = (in_map.y - frame_.origin.y) * per_metre_ - 0.5;
    // A comparison that NaN fails.
    if (!(x >= 0.0 && y >= 0.0 && x < last_column_ && y < last_row_)) return false;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const auto columns = static_cast<std::size_t>(frame_.columns);
    const std::size_t at = static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    if (whole_[at] != part) return false;
    const auto u = static_cast<float>(x - column), v = static_cast<float>(y - row);
    const Look& a = cells_[at];
    const Look& b = cells_[at + 1];
    const Look& c = cells_[at + columns];
    const Look& d = cells_[at + columns + 1];
    const float wa = (1.0F - u) * (1.0F - v), wb = u * (1.0F - v), wc = (1.0F - u) * v, wd = u * v;
    look.brightness = wa * a.brightness + wb * b.brightness + wc * c.brightness + wd * d.brightness;
    look.by_x = wa * a.by_x + wb * b.by_x + wc * c.by_x + wd * d.by_x;
    look.by_y = wa * a.by_y + wb * b.by_y + wc * c.by_y + wd * d.by_y;
    return true;
  }

 private:
  struct Own {};
  MosaicLevel(const CeilingMosaic& mosaic, double blur, Own);

  GridFrame frame_;
  std::vector<double> heights_;
  double blur_;
  double per_metre_;
  double last_column_;
  double last_row_;
  std::vector<Look> cells_;
  std::vector<std::uint8_t> whole_;  ///< the part of the four cells right of and above this one, where they have one
};

/// Levels from coarse to fine.
using MosaicPyramid = std::vector<MosaicLevel>;
/// @param blurs  [m] of the levels, coarse to fine
[[nodiscard]] MosaicPyramid pyramid_of(const CeilingMosaic& mosaic, const std::vector<double>& blurs);

}  // namespace docent::vision
