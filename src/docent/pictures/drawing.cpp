#include "docent/pictures/drawing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/geometry/polygon.h"

namespace docent {
namespace {

/// A part of the image, in pixels; `high` is not included. Empty when nothing of it lies inside.
struct PixelBox {
  int low_x = 0;
  int low_y = 0;
  int high_x = 0;
  int high_y = 0;
  [[nodiscard]] bool empty() const { return low_x >= high_x || low_y >= high_y; }
};

/// The pixels within `margin` of the points; cut at the image's border before the numbers become integers.
PixelBox box_around(const Image& image, std::span<const Point2> points, double margin) {
  if (points.empty()) return {};
  double low_x = points[0].x, low_y = points[0].y, high_x = points[0].x, high_y = points[0].y;
  for (const Point2& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return {};
    low_x = std::min(low_x, point.x);
    low_y = std::min(low_y, point.y);
    high_x = std::max(high_x, point.x);
    high_y = std::max(high_y, point.y);
  }
  const auto cut = [](double value, int limit) { return static_cast<int>(std::clamp(value, 0.0, double(limit))); };
  return {cut(std::floor(low_x - margin), image.width()), cut(std::floor(low_y - margin), image.height()),
          cut(std::ceil(high_x + margin), image.width()), cut(std::ceil(high_y + margin), image.height())};
}

/// How much of a pixel a shape covers whose edge is `inside` pixels away from the pixel's centre (> 0: inside).
double edge_coverage(double inside) { return std::clamp(inside + 0.5, 0.0, 1.0); }

/// Raises the coverage of every pixel near the line to what the line covers.
void cover_line(std::vector<float>& coverage, const PixelBox& whole, const PixelBox& part, const Segment& line,
                double half_width) {
  const auto stride = static_cast<std::size_t>(whole.high_x - whole.low_x);
  for (int y = part.low_y; y < part.high_y; ++y) {
    for (int x = part.low_x; x < part.high_x; ++x) {
      const double away = distance(line, Point2{x + 0.5, y + 0.5});
      float& pixel =
          coverage[static_cast<std::size_t>(y - whole.low_y) * stride + static_cast<std::size_t>(x - whole.low_x)];
      pixel = std::max(pixel, static_cast<float>(edge_coverage(half_width - away)));
    }
  }
}

}  // namespace

void fill_polygon(Image& image, std::span<const Point2> corners, Color color) {
  if (corners.size() < 3) return;
  const PixelBox box = box_around(image, corners, 1.0);
  if (box.empty()) return;
  // Five scan lines a pixel row; along each the covered part of every pixel is exact.
  constexpr int kLines = 5;
  std::vector<double> covered(static_cast<std::size_t>(box.high_x - box.low_x));
  std::vector<double> crossings;
  for (int y = box.low_y; y < box.high_y; ++y) {
    std::fill(covered.begin(), covered.end(), 0.0);
    for (int line = 0; line < kLines; ++line) {
      const double at_y = y + (line + 0.5) / kLines;
      crossings.clear();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point2 a = corners[i];
        const Point2 b = corners[(i + 1) % corners.size()];
        if ((a.y <= at_y) != (b.y <= at_y)) crossings.push_back(a.x + (at_y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const double left = std::clamp(crossings[i], double(box.low_x), double(box.high_x));
        const double right = std::clamp(crossings[i + 1], double(box.low_x), double(box.high_x));
        for (int x = static_cast<int>(left); x < box.high_x && x < right; ++x) {
          const double part = std::min(right, x + 1.0) - std::max(left, double(x));
          covered[static_cast<std::size_t>(x - box.low_x)] += part / kLines;
        }
      }
    }
    for (int x = box.low_x; x < box.high_x; ++x)
      image.blend(x, y, color, covered[static_cast<std::size_t>(x - box.low_x)]);
  }
}

void draw_polygon(Image& image, std::span<const Point2> corners, double width, Color color) {
  if (corners.empty()) return;
  std::vector<Point2> closed{corners.begin(), corners.end()};
  closed.push_back(corners[0]);
  draw_polyline(image, closed, width, color);
}

void draw_line(Image& image, Point2 from, Point2 to, double width, Color color) {
  const Point2 ends[] = {from, to};
  const PixelBox box = box_around(image, ends, width / 2.0 + 1.0);
  for (int y = box.low_y; y < box.high_y; ++y)
    for (int x = box.low_x; x < box.high_x; ++x) {
      const double away = distance(Segment{from, to}, Point2{x + 0.5, y + 0.5});
      image.blend(x, y, color, edge_coverage(width / 2.0 - away));
    }
}

void draw_polyline(Image& image, std::span<const Point2> points, double width, Color color) {
  const double margin = width / 2.0 + 1.0;
  const PixelBox whole = box_around(image, points, margin);
  if (whole.empty()) return;
  std::vector<float> coverage(static_cast<std::size_t>(whole.high_x - whole.low_x) *
                              static_cast<std::size_t>(whole.high_y - whole.low_y));
  for (std::size_t i = 0; i + 1 < points.size() || i == 0; ++i) {
    const Segment line{points[i], points[std::min(i + 1, points.size() - 1)]};
    const Point2 ends[] = {line.a, line.b};
    cover_line(coverage, whole, box_around(image, ends, margin), line, width / 2.0);
  }
  std::size_t pixel = 0;
  for (int y = whole.low_y; y < whole.high_y; ++y)
    for (int x = whole.low_x; x < whole.high_x; ++x) image.blend(x, y, color, coverage[pixel++]);
}

void draw_arrow(Image& image, Point2 from, Point2 to, double width, Color color) {
  const double length = distance(from, to);
  if (!(length > 0.0)) return;
  const Point2 along = 1.0 / length * (to - from);
  const Point2 across{-along.y, along.x};
  const double head = std::min(length, 4.0 * width);
  const Point2 neck = to - head * along;
  draw_line(image, from, neck, width, color);
  const Point2 corners[] = {to, neck + 0.5 * head * across, neck - 0.5 * head * across};
  fill_polygon(image, corners, color);
}

void fill_disc(Image& image, Point2 centre, double radius, Color color) {
  draw_line(image, centre, centre, 2.0 * radius, color);
}

void draw_circle(Image& image, Point2 centre, double radius, double width, Color color) {
  const Point2 points[] = {centre};
  const PixelBox box = box_around(image, points, radius + width / 2.0 + 1.0);
  for (int y = box.low_y; y < box.high_y; ++y)
    for (int x = box.low_x; x < box.high_x; ++x) {
      const double away = std::abs(distance(centre, Point2{x + 0.5, y + 0.5}) - radius);
      image.blend(x, y, color, edge_coverage(width / 2.0 - away));
    }
}

void fill_rectangle(Image& image, Point2 top_left, Point2 bottom_right, Color color) {
  const Point2 corners[] = {top_left, {bottom_right.x, top_left.y}, bottom_right, {top_left.x, bottom_right.y}};
  fill_polygon(image, corners, color);
}

}  // namespace docent
