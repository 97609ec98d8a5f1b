#include "docent/simulator/world/world_picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "docent/pictures/drawing.h"
#include "docent/pictures/text.h"

namespace docent::simulator {
namespace {

constexpr Color kOutside{196, 193, 186};
constexpr Color kWall{62, 66, 80};
constexpr Color kWood{176, 142, 104};
constexpr Color kLowWood{214, 190, 160};
constexpr Color kGlass{120, 190, 220, 130};
constexpr Color kPlate{168, 176, 184};
constexpr Color kStairs{200, 90, 70};

Color color_of(const Solid& solid) {
  switch (solid.kind) {
    case SolidKind::wall:
      return kWall;
    case SolidKind::furniture:
      return is_seen_by_laser(solid) ? kWood : kLowWood;
    case SolidKind::glass:
      return kGlass;
    case SolidKind::plate:
      return kPlate;
    case SolidKind::stairs:
      return kStairs;
  }
  return kWall;
}

Point2 middle(const Polygon& polygon) {
  Point2 sum{};
  for (const Point2 corner : polygon) sum = sum + corner;
  return (1.0 / static_cast<double>(polygon.size())) * sum;
}

}  // namespace

Image draw_world(const World& world, const MapView& view) {
  Image image{view.width(), view.height(), kOutside};
  fill_polygon(image, view.pixels(world.floor), colors::kFloor);
  for (const auto& part : world.ceiling) fill_polygon(image, view.pixels(part.polygon), Color{255, 236, 190, 90});
  // Low things first: what stands on a podium is drawn over it, glass over what it covers.
  std::vector<const Solid*> solids;
  for (const Solid& solid : world.solids) solids.push_back(&solid);
  std::stable_sort(solids.begin(), solids.end(), [](const Solid* a, const Solid* b) {
    const auto order = [](const Solid& s) { return s.kind == SolidKind::glass ? 100.0 : s.top; };
    return order(*a) < order(*b);
  });
  for (const Solid* solid : solids) {
    const auto corners = view.pixels(solid->polygon);
    fill_polygon(image, corners, color_of(*solid));
    if (solid->kind != SolidKind::wall) {
      const Color edge = solid->kind == SolidKind::glass ? Color{40, 120, 170} : Color{90, 80, 70};
      draw_polygon(image, corners, solid->movable ? 2.5 : 1.2, edge);
    }
  }
  draw_polygon(image, view.pixels(world.operating_area), 1.5, with_alpha(colors::kGreen, 170));
  for (const auto& attraction : world.attractions) {
    draw_circle(image, view.pixel(attraction.centre), attraction.radius * view.scale(), 1.0,
                with_alpha(colors::kViolet, 70));
  }
  const auto label = [&](Point2 in_world, const std::string& text) {
    const Point2 at = view.pixel(in_world);
    const Point2 top_left{at.x - 0.5 * text_width(text), at.y - 0.5 * text_height()};
    draw_label(image, top_left, text, colors::kInk, with_alpha(colors::kWhite, 150));
  };
  for (const auto& attraction : world.attractions) label(attraction.centre, attraction.id);
  for (const Solid& solid : world.solids) {
    const Point2 centre = middle(solid.polygon);
    const bool is_named = std::any_of(world.attractions.begin(), world.attractions.end(),
                                      [&](const Attraction& a) { return distance(a.centre, centre) < a.radius; });
    if ((solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs || solid.kind == SolidKind::furniture) &&
        !is_named && std::abs(signed_area(solid.polygon)) > 0.5) {
      label(centre, solid.id);
    }
  }
  for (const Point2 entrance : world.entrances) fill_disc(image, view.pixel(entrance), 6.0, colors::kOrange);
  fill_disc(image, view.pixel(world.home), 6.0, colors::kBlue);
  return image;
}

Image draw_world(const World& world, int longest_side) {
  Point2 low = world.floor.front();
  Point2 high = low;
  const auto extend = [&](const Polygon& polygon) {
    for (const Point2 p : polygon) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  };
  extend(world.floor);
  for (const Solid& solid : world.solids) extend(solid.polygon);
  low = low - Point2{0.5, 0.5};
  high = high + Point2{0.5, 0.5};
  const double side = std::max(high.x - low.x, high.y - low.y);
  return draw_world(world, MapView{low, high, longest_side / side});
}

}  // namespace docent::simulator
