#pragma once

#include <functional>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/pictures/figure.h"

// Layers of axes in metres: maps, what is believed, ways and robots.

namespace docent::pictures {

/// The room that a grid takes, with `values` one a cell (row-major) coloured by `color`; NaN stays clear. A pixel of a
/// raster that is larger than a cell shows the greatest value under it, so that a single cell does not vanish.
void draw_cells(Axes& axes, const GridFrame& frame, std::span<const float> values,
                const std::function<Color(float)>& color);

/// Floor, walls and the unknown.
void draw_map(Axes& axes, const OccupancyGrid& map);
/// What they look like, for the legend.
void add_map_legend(Figure& figure);

/// A probability for each cell (row-major), coloured by `heat` on a logarithmic scale of the density from 1e-4 to
/// 100 m^-2, which is the same for all pictures: from less than uniform over a large museum to sure to 10 cm. What is
/// less stays clear.
void draw_density(Axes& axes, const GridFrame& frame, std::span<const float> mass);
/// What its colours mean.
[[nodiscard]] ColorBar density_bar();

/// A disc with a line towards the front; `radius` [m].
void draw_robot(Axes& axes, const Pose2& map_from_robot, double radius, Color color);
/// Points in the map as dots of `diameter` [points]: endpoints of a scan, particles.
void draw_points(Axes& axes, std::span<const Point2> in_map, double diameter, Color color);
/// `width` [points]
void draw_path(Axes& axes, std::span<const Point2> in_map, double width, Color color);
/// A filled shape with a darker outline: an area, a hazard.
void draw_area(Axes& axes, std::span<const Point2> corners_in_map, Color color);
[[nodiscard]] LegendEntry legend_of_area(std::string text, Color color);

/// A place at a time [s].
struct TimedPoint {
  double time = 0.0;
  Point2 place;
};
/// A way coloured by `rainbow` from the first to the last time, with a colour bar where these differ.
void draw_timed_path(Axes& axes, std::span<const TimedPoint> way, double width);

}  // namespace docent::pictures
