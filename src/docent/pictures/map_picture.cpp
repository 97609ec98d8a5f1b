#include "docent/pictures/map_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "docent/base/check.h"

namespace docent::pictures {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kLeastShown = 1e-4;  // [1/m2] of the colours
constexpr double kMostDensity = 1e2;

Color color_of(float percent) {
  if (percent < 0.0F) return colors::kUnknown;
  return mixed(colors::kFloor, colors::kInk, static_cast<double>(percent) / 100.0);
}

/// A part of a grid, both ends within.
struct Cells {
  CellIndex low;
  CellIndex high;
};

CellIndex nearest_cell(const GridFrame& frame, Point2 place) {
  const CellIndex cell = frame.cell_at(place);
  return {std::clamp(cell.column, 0, frame.columns - 1), std::clamp(cell.row, 0, frame.rows - 1)};
}

float greatest(const GridFrame& frame, std::span<const float> values, Cells cells) {
  float found = kNothing;
  for (int row = cells.low.row; row <= cells.high.row; ++row)
    for (int column = cells.low.column; column <= cells.high.column; ++column)
      if (const float value = values[frame.index({column, row})]; !(value <= found) && !std::isnan(value))
        found = value;
  return found;
}

}  // namespace

void draw_cells(Axes& axes, const GridFrame& frame, std::span<const float> values,
                const std::function<Color(float)>& color) {
  DOCENT_CHECK(values.size() == frame.size());
  if (values.empty()) return;
  // The part of the grid that is seen, and its bitmap: cells, or pixels where these are larger.
  const Cells seen{nearest_cell(frame, axes.low()), nearest_cell(frame, axes.high())};
  const double half = 0.5 * frame.resolution;
  const Point2 low = frame.centre(seen.low) - Point2{half, half};
  const Point2 high = frame.centre(seen.high) + Point2{half, half};
  const int columns = seen.high.column - seen.low.column + 1;
  const int rows = seen.high.row - seen.low.row + 1;
  const double pixel = std::max(frame.resolution, 1.0 / (kPixelsPerPoint * axes.scale()));  // [m]
  const auto count = [pixel](double length, int cells) {
    return std::clamp(static_cast<int>(std::ceil(length / pixel - 1e-6)), 1, cells);
  };
  const int width = count(high.x - low.x, columns);
  const int height = count(high.y - low.y, rows);
  const auto image = std::make_shared<Image>(width, height, Color{0, 0, 0, 0});
  for (int y = 0; y < height; ++y) {
    const int first_row = seen.low.row + (height - 1 - y) * rows / height;
    const int last_row = seen.low.row + ((height - y) * rows - 1) / height;
    for (int x = 0; x < width; ++x) {
      const Cells under{{seen.low.column + x * columns / width, first_row},
                        {seen.low.column + ((x + 1) * columns - 1) / width, last_row}};
      const float value = greatest(frame, values, under);
      if (!std::isnan(value)) image->set(x, y, color(value));
    }
  }
  axes.add([image, top_left = axes.page({low.x, high.y}), bottom_right = axes.page({high.x, low.y})](Canvas& canvas) {
    canvas.draw_image(*image, top_left, bottom_right);
  });
}

void draw_map(Axes& axes, const OccupancyGrid& map) {
  axes.add([corner = Point2{axes.width(), axes.height()}](Canvas& canvas) {
    canvas.fill_rectangle({0.0, 0.0}, corner, colors::kUnknown);
  });
  const std::vector<float> percent{map.cells.begin(), map.cells.end()};
  draw_cells(axes, map.frame, percent, color_of);
}

void add_map_legend(Figure& figure) {
  figure.add_legend(legend_area("free", colors::kFloor, colors::kGrey));
  figure.add_legend(legend_area("occupied", colors::kInk));
  figure.add_legend(legend_area("unknown", colors::kUnknown, colors::kGrey));
}

namespace {

Color color_of_density(double density) {
  const double decades = std::log10(kMostDensity / kLeastShown);
  const double share = std::clamp(std::log10(density / kLeastShown) / decades, 0.0, 1.0);
  return with_alpha(heat(share), static_cast<std::uint8_t>(110 + 120 * share));
}

}  // namespace

void draw_density(Axes& axes, const GridFrame& frame, std::span<const float> mass) {
  const double area = frame.resolution * frame.resolution;
  std::vector<float> density{mass.begin(), mass.end()};
  for (float& value : density) {
    value = static_cast<float>(static_cast<double>(value) / area);
    if (!(static_cast<double>(value) > kLeastShown)) value = kNothing;
  }
  draw_cells(axes, frame, density, [](float value) { return color_of_density(static_cast<double>(value)); });
}

ColorBar density_bar() { return {"probability density [1/m²]", color_of_density, kLeastShown, kMostDensity, true}; }

void draw_robot(Axes& axes, const Pose2& map_from_robot, double radius, Color color) {
  const double size = std::max(2.0, radius * axes.scale());
  const Point2 centre = axes.page(map_from_robot.position());
  const Point2 heading = unit(map_from_robot.theta);
  const Point2 front = centre + size * Point2{heading.x, -heading.y};
  axes.add([=](Canvas& canvas) {
    const Point2 centres[] = {centre};
    canvas.fill_discs(centres, 2.0 * size, with_alpha(color, 190));
    canvas.draw_circle(centre, size, 0.8, mixed(color, colors::kBlack, 0.4));
    canvas.draw_line(centre, front, std::max(0.8, size / 5.0), colors::kWhite);
  });
}

void draw_points(Axes& axes, std::span<const Point2> in_map, double diameter, Color color) {
  axes.add([=, places = axes.page(in_map)](Canvas& canvas) { canvas.fill_discs(places, diameter, color); });
}

void draw_path(Axes& axes, std::span<const Point2> in_map, double width, Color color) {
  axes.add([=, places = axes.page(in_map)](Canvas& canvas) { canvas.draw_polyline(places, width, color); });
}

namespace {

Color outline_of(Color color) { return with_alpha(mixed(color, colors::kBlack, 0.3), 255); }

}  // namespace

void draw_area(Axes& axes, std::span<const Point2> corners_in_map, Color color) {
  axes.add([=, corners = axes.page(corners_in_map)](Canvas& canvas) {
    canvas.fill_polygon(corners, color);
    canvas.draw_polygon(corners, 0.8, outline_of(color));
  });
}

LegendEntry legend_of_area(std::string text, Color color) {
  return legend_area(std::move(text), color, outline_of(color));
}

void draw_timed_path(Axes& axes, std::span<const TimedPoint> way, double width) {
  if (way.empty()) return;
  constexpr std::size_t kPieces = 64;  // steps of colour
  const double begin = way.front().time;
  const double end = way.back().time;
  const auto color = [=](double time) { return rainbow(end > begin ? (time - begin) / (end - begin) : 0.0); };
  const std::size_t piece = std::max<std::size_t>(1, way.size() / kPieces);
  for (std::size_t first = 0; first < way.size(); first += piece) {
    std::vector<Point2> points;
    for (std::size_t i = first; i <= std::min(first + piece, way.size() - 1); ++i) points.push_back(way[i].place);
    draw_path(axes, points, width, color(way[first].time));
  }
  if (end > begin) axes.set_color_bar({"time [s]", color, begin, end, false});
}

}  // namespace docent::pictures
