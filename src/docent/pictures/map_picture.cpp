#include "docent/pictures/map_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "docent/base/check.h"
#include "docent/pictures/drawing.h"
#include "docent/pictures/text.h"

namespace docent {
namespace {

Color color_of(std::int8_t percent) {
  if (percent < 0) return colors::kUnknown;
  return mixed(colors::kFloor, colors::kInk, percent / 100.0);
}

/// The most occupied cell of the rectangle; unknown only where nothing else is.
std::int8_t darkest(const OccupancyGrid& map, CellIndex low, CellIndex high) {
  std::int8_t found = OccupancyGrid::kUnknown;
  for (int row = low.row; row <= high.row; ++row)
    for (int column = low.column; column <= high.column; ++column) found = std::max(found, map.at({column, row}));
  return found;
}

/// The longest round length that takes no more than a quarter of the width.
void draw_scale_bar(Image& image, const MapView& view) {
  constexpr std::array<double, 9> kLengths{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0};
  const auto longest = std::find_if(kLengths.rbegin(), kLengths.rend(),
                                    [&](double length) { return length * view.scale() <= 0.25 * view.width(); });
  if (longest == kLengths.rend() || view.height() < 40) return;
  const double y = view.height() - 10.0;
  const Point2 left{10.0, y};
  const Point2 right{10.0 + *longest * view.scale(), y};
  draw_line(image, left, right, 2.0, colors::kInk);
  for (const Point2& end : {left, right}) draw_line(image, end - Point2{0, 4}, end + Point2{0, 4}, 2.0, colors::kInk);
  std::string text = *longest < 1.0 ? std::to_string(std::lround(*longest * 100.0)) + " cm"
                                    : std::to_string(std::lround(*longest)) + " m";
  draw_label(image, {left.x + 6.0, y - 15.0}, text, colors::kInk, with_alpha(colors::kWhite, 170));
}

}  // namespace

MapView::MapView(Point2 low, Point2 high, double pixels_per_metre) : low_{low}, high_{high}, scale_{pixels_per_metre} {
  DOCENT_CHECK(high.x > low.x && high.y > low.y && pixels_per_metre > 0.0);
  width_ = static_cast<int>(std::clamp(std::ceil(scale_ * (high.x - low.x) - 1e-6), 1.0, 16384.0));
  height_ = static_cast<int>(std::clamp(std::ceil(scale_ * (high.y - low.y) - 1e-6), 1.0, 16384.0));
}

MapView MapView::whole(const GridFrame& frame, int longest_side) {
  const Point2 size{frame.columns * frame.resolution, frame.rows * frame.resolution};
  return {frame.origin, frame.origin + size, longest_side / std::max(size.x, size.y)};
}

std::vector<Point2> MapView::pixels(std::span<const Point2> in_map) const {
  std::vector<Point2> result;
  result.reserve(in_map.size());
  for (const Point2& point : in_map) result.push_back(pixel(point));
  return result;
}

Image draw_map(const OccupancyGrid& map, const MapView& view) {
  Image image{view.width(), view.height(), colors::kUnknown};
  // Just inside the pixel's border, so that a pixel as large as a cell does not see the next one.
  constexpr double kInset = 0.01;
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      const CellIndex low = map.frame.cell_at(view.map({x + kInset, y + 1 - kInset}));
      const CellIndex high = map.frame.cell_at(view.map({x + 1 - kInset, y + kInset}));
      image.set(x, y, color_of(darkest(map, low, high)));
    }
  }
  draw_scale_bar(image, view);
  return image;
}

Image draw_map(const OccupancyGrid& map, int longest_side) {
  return draw_map(map, MapView::whole(map.frame, longest_side));
}

void draw_density(Image& image, const MapView& view, const GridFrame& frame, std::span<const float> mass) {
  DOCENT_CHECK(mass.size() == frame.size());
  const float greatest = mass.empty() ? 0.0F : *std::max_element(mass.begin(), mass.end());
  if (!(greatest > 0.0F)) return;
  constexpr double kDecades = 3.0;
  // A cell smaller than a pixel must not vanish: every cell draws at least one pixel.
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const float value = mass[frame.index({column, row})];
      if (!(value > 0.0F)) continue;
      const double share = 1.0 + std::log10(value / greatest) / kDecades;
      if (share <= 0.0) continue;
      const Point2 low{frame.origin.x + column * frame.resolution, frame.origin.y + row * frame.resolution};
      const Point2 top_left = view.pixel({low.x, low.y + frame.resolution});
      const Point2 bottom_right = view.pixel({low.x + frame.resolution, low.y});
      const Color color = with_alpha(heat(share), static_cast<std::uint8_t>(110 + 120 * share));
      const int left = static_cast<int>(std::floor(top_left.x + 0.5));
      const int top = static_cast<int>(std::floor(top_left.y + 0.5));
      const int right = std::max(left + 1, static_cast<int>(std::floor(bottom_right.x + 0.5)));
      const int bottom = std::max(top + 1, static_cast<int>(std::floor(bottom_right.y + 0.5)));
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) image.blend(x, y, color);
    }
  }
}

void draw_robot(Image& image, const MapView& view, const Pose2& map_from_robot, double radius, Color color) {
  const double pixels = std::max(3.0, radius * view.scale());
  const Point2 centre = view.pixel(map_from_robot.position());
  const Point2 heading = unit(map_from_robot.theta);
  const Point2 front = centre + pixels * Point2{heading.x, -heading.y};
  fill_disc(image, centre, pixels, with_alpha(color, 190));
  draw_circle(image, centre, pixels, 1.5, mixed(color, colors::kBlack, 0.4));
  draw_line(image, centre, front, std::max(1.5, pixels / 5.0), colors::kWhite);
}

void draw_points(Image& image, const MapView& view, std::span<const Point2> in_map, double diameter, Color color) {
  for (const Point2& point : in_map) fill_disc(image, view.pixel(point), diameter / 2.0, color);
}

void draw_path(Image& image, const MapView& view, std::span<const Point2> in_map, double width, Color color) {
  draw_polyline(image, view.pixels(in_map), width, color);
}

void draw_area(Image& image, const MapView& view, std::span<const Point2> corners_in_map, Color color) {
  const std::vector<Point2> corners = view.pixels(corners_in_map);
  fill_polygon(image, corners, color);
  draw_polygon(image, corners, 1.5, with_alpha(mixed(color, colors::kBlack, 0.3), 255));
}

}  // namespace docent
