#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/pictures/image.h"

namespace docent {

/// Between the map's frame (metres, y up) and the pixels of a picture (y down).
class MapView {
 public:
  /// Shows the rectangle low..high of the map; @pre high > low, pixels_per_metre > 0.
  MapView(Point2 low, Point2 high, double pixels_per_metre);
  /// The whole grid, its longer side `longest_side` pixels long.
  [[nodiscard]] static MapView whole(const GridFrame& frame, int longest_side = 900);

  [[nodiscard]] int width() const { return width_; }     ///< [pixels]
  [[nodiscard]] int height() const { return height_; }   ///< [pixels]
  [[nodiscard]] double scale() const { return scale_; }  ///< [pixels/m]
  [[nodiscard]] Point2 pixel(Point2 in_map) const {
    return {scale_ * (in_map.x - low_.x), scale_ * (high_.y - in_map.y)};
  }
  [[nodiscard]] Point2 map(Point2 pixel) const { return {low_.x + pixel.x / scale_, high_.y - pixel.y / scale_}; }
  [[nodiscard]] std::vector<Point2> pixels(std::span<const Point2> in_map) const;

 private:
  Point2 low_;
  Point2 high_;
  double scale_;
  int width_;
  int height_;
};

/// Floor, walls and the unknown, with a scale bar in the corner. A pixel smaller than a cell shows the cell, a larger
/// one the darkest cell under it, so that thin walls stay.
[[nodiscard]] Image draw_map(const OccupancyGrid& map, const MapView& view);
[[nodiscard]] Image draw_map(const OccupancyGrid& map, int longest_side = 900);

/// Lays a density over the picture, coloured by `heat`: `mass` has one value a cell of `frame` (row-major); cells under
/// a thousandth of the greatest stay clear. The scale is logarithmic over three decades.
void draw_density(Image& image, const MapView& view, const GridFrame& frame, std::span<const float> mass);

/// A disc with a line towards the front; `radius` [m].
void draw_robot(Image& image, const MapView& view, const Pose2& map_from_robot, double radius, Color color);
/// Points in the map as dots of `diameter` pixels: endpoints of a scan, particles.
void draw_points(Image& image, const MapView& view, std::span<const Point2> in_map, double diameter, Color color);
void draw_path(Image& image, const MapView& view, std::span<const Point2> in_map, double width, Color color);
/// A filled shape with a darker outline: an area, a hazard.
void draw_area(Image& image, const MapView& view, std::span<const Point2> corners_in_map, Color color);

}  // namespace docent
