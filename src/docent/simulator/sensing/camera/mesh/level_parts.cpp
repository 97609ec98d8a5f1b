#include "docent/simulator/sensing/camera/mesh/level_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace docent::simulator {
namespace {

constexpr double kThin = 1e-6;  // [m] nothing is thinner

/// Share of the way along `first` at which `second` crosses it; nullopt: it does not, or is parallel.
std::optional<double> crossing(const Segment& first, const Segment& second) {
  const Point2 along = first.b - first.a, other = second.b - second.a;
  const double area = cross(along, other);
  if (std::abs(area) < 1e-12) return std::nullopt;
  const double share = cross(second.a - first.a, other) / area;
  const double of_second = cross(second.a - first.a, along) / area;
  if (share < 0.0 || share > 1.0 || of_second < 0.0 || of_second > 1.0) return std::nullopt;
  return share;
}

std::vector<Segment> sides_of_all(std::span<const Polygon> polygons) {
  std::vector<Segment> all;
  for (const Polygon& polygon : polygons)
    for (const Segment& side : sides(polygon)) all.push_back(side);
  return all;
}

void sort_and_thin(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end(), [](double a, double b) { return b - a < kThin; }),
               values.end());
}

double height_at(const Segment& side, double x) {
  return side.a.y + (side.b.y - side.a.y) * (x - side.a.x) / (side.b.x - side.a.x);
}

class Cutter {
 public:
  Cutter(Point2 low, Point2 high, std::span<const Polygon> polygons)
      : low_{low}, high_{high}, polygons_{polygons}, sides_{sides_of_all(polygons)} {}

  LevelParts cut() {
    std::vector<double> stops{low_.x, high_.x};
    const auto add = [&](double x) {
      if (x > low_.x && x < high_.x) stops.push_back(x);
    };
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      add(sides_[i].a.x);
      for (std::size_t k = 0; k < i; ++k)
        if (const auto share = crossing(sides_[i], sides_[k]))
          add(sides_[i].a.x + *share * (sides_[i].b.x - sides_[i].a.x));
      for (const double y : {low_.y, high_.y})  // where it leaves the rectangle
        if (const auto share = crossing(sides_[i], {{low_.x, y}, {high_.x, y}}))
          add(sides_[i].a.x + *share * (sides_[i].b.x - sides_[i].a.x));
    }
    sort_and_thin(stops);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) fill_slab(stops[i], stops[i + 1]);
    for (const Segment& side : sides_) add_borders(side);
    return std::move(parts_);
  }

 private:
  /// No two sides cross between the two.
  void fill_slab(double from, double to) {
    const double middle = 0.5 * (from + to);
    struct Line {
      double first, middle, last;
    };
    std::vector<Line> lines{{low_.y, low_.y, low_.y}, {high_.y, high_.y, high_.y}};
    for (const Segment& side : sides_) {
      if (std::min(side.a.x, side.b.x) >= middle || std::max(side.a.x, side.b.x) <= middle) continue;
      const double y = height_at(side, middle);
      if (y <= low_.y || y >= high_.y) continue;
      lines.push_back({height_at(side, from), y, height_at(side, to)});
    }
    std::sort(lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.middle < b.middle; });
    std::size_t begin = 0;
    int owner = owner_at(polygons_, {middle, 0.5 * (lines[0].middle + lines[1].middle)});
    for (std::size_t i = 1; i < lines.size(); ++i) {
      const bool is_last = i + 1 == lines.size();
      const int next = is_last ? -2 : owner_at(polygons_, {middle, 0.5 * (lines[i].middle + lines[i + 1].middle)});
      if (next == owner) continue;
      if (lines[i].middle - lines[begin].middle > kThin)
        parts_.pieces.push_back(
            {{{{from, lines[begin].first}, {to, lines[begin].last}, {to, lines[i].last}, {from, lines[i].first}}},
             owner});
      begin = i;
      owner = next;
    }
  }

  void add_borders(const Segment& side) {
    std::vector<double> stops{0.0, 1.0};
    for (const Segment& other : sides_)
      if (const auto share = crossing(side, other)) stops.push_back(*share);
    sort_and_thin(stops);
    const Point2 along = side.b - side.a;
    const double length = norm(along);
    if (length < kThin) return;
    const Point2 left = (1e-4 / length) * Point2{-along.y, along.x};  // [m]
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Segment piece{side.a + stops[i] * along, side.a + stops[i + 1] * along};
      const Point2 middle = 0.5 * (piece.a + piece.b);
      if (middle.x < low_.x || middle.x > high_.x || middle.y < low_.y || middle.y > high_.y) continue;
      const int on_left = owner_at(polygons_, middle + left), on_right = owner_at(polygons_, middle - left);
      if (on_left != on_right) parts_.borders.push_back({piece, on_left, on_right});
    }
  }

  Point2 low_, high_;
  std::span<const Polygon> polygons_;
  std::vector<Segment> sides_;
  LevelParts parts_;
};

}  // namespace

int owner_at(std::span<const Polygon> polygons, Point2 point) {
  for (std::size_t i = polygons.size(); i > 0; --i)
    if (contains(polygons[i - 1], point)) return static_cast<int>(i - 1);
  return -1;
}

LevelParts level_parts(Point2 low, Point2 high, std::span<const Polygon> polygons) {
  return Cutter{low, high, polygons}.cut();
}

}  // namespace docent::simulator
