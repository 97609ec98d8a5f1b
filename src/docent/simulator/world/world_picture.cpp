#include "docent/simulator/world/world_picture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "docent/pictures/notes.h"

namespace docent::simulator {
namespace {

constexpr pictures::Color kOutside{196, 193, 186};
constexpr pictures::Color kWall{62, 66, 80};
constexpr pictures::Color kWood{176, 142, 104};
constexpr pictures::Color kLowWood{214, 190, 160};
constexpr pictures::Color kGlass{120, 190, 220, 130};
constexpr pictures::Color kPlate{168, 176, 184};
constexpr pictures::Color kStairs{200, 90, 70};
constexpr pictures::Color kGlassEdge{40, 120, 170};
constexpr pictures::Color kEdge{90, 80, 70};
constexpr pictures::Color kHighCeiling{255, 236, 190, 90};
constexpr pictures::Color kArea = pictures::with_alpha(pictures::colors::kGreen, 170);
constexpr pictures::Color kAttraction = pictures::with_alpha(pictures::colors::kViolet, 70);
constexpr pictures::Color kHazard{206, 48, 44, 90};

// [points]
constexpr double kDot = 6.0;
constexpr double kLine = 0.6;
constexpr double kThickLine = 1.3;  // of what someone may have moved

pictures::Color color_of(const Solid& solid) {
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

bool is_low(const Solid& solid) { return solid.kind == SolidKind::furniture && !is_seen_by_laser(solid); }

Point2 middle(const Polygon& polygon) {
  Point2 sum{};
  for (const Point2 corner : polygon) sum = sum + corner;
  return (1.0 / static_cast<double>(polygon.size())) * sum;
}

/// Of the places that people like, and of the large things that are no such place.
void draw_names(pictures::Axes& axes, const World& world) {
  std::vector<pictures::Note> names;
  for (const auto& attraction : world.attractions) names.push_back({attraction.centre, attraction.id, {0.5, 0.5}});
  for (const Solid& solid : world.solids) {
    const Point2 centre = middle(solid.polygon);
    const bool is_named = std::any_of(world.attractions.begin(), world.attractions.end(),
                                      [&](const Attraction& a) { return distance(a.centre, centre) < a.radius; });
    if ((solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs || solid.kind == SolidKind::furniture) &&
        !is_named && std::abs(signed_area(solid.polygon)) > 0.5) {
      names.push_back({centre, solid.id, {0.5, 0.5}});
    }
  }
  std::vector<Point2> dots = world.entrances;
  dots.push_back(world.home);
  pictures::draw_notes(axes, names, dots, kDot);
}

}  // namespace

void draw_world(pictures::Axes& axes, const World& world) {
  axes.add([corner = Point2{axes.width(), axes.height()}, floor = axes.page(world.floor)](pictures::Canvas& canvas) {
    canvas.fill_rectangle({0.0, 0.0}, corner, kOutside);
    canvas.fill_polygon(floor, pictures::colors::kFloor);
  });
  for (const auto& part : world.ceiling)
    axes.add(
        [corners = axes.page(part.polygon)](pictures::Canvas& canvas) { canvas.fill_polygon(corners, kHighCeiling); });
  // Low things first: what stands on a podium is drawn over it, glass over what it covers.
  std::vector<const Solid*> solids;
  for (const Solid& solid : world.solids) solids.push_back(&solid);
  std::stable_sort(solids.begin(), solids.end(), [](const Solid* a, const Solid* b) {
    const auto order = [](const Solid& s) { return s.kind == SolidKind::glass ? 100.0 : s.top; };
    return order(*a) < order(*b);
  });
  for (const Solid* solid : solids) {
    axes.add([corners = axes.page(solid->polygon), color = color_of(*solid), kind = solid->kind,
              width = solid->movable ? kThickLine : kLine](pictures::Canvas& canvas) {
      canvas.fill_polygon(corners, color);
      if (kind != SolidKind::wall) canvas.draw_polygon(corners, width, kind == SolidKind::glass ? kGlassEdge : kEdge);
    });
  }
  draw_operating_area(axes, world);
  for (const auto& attraction : world.attractions) {
    axes.add([centre = axes.page(attraction.centre), radius = attraction.radius * axes.scale()](
                 pictures::Canvas& canvas) { canvas.draw_circle(centre, radius, kLine, kAttraction); });
  }
  pictures::draw_points(axes, world.entrances, kDot, pictures::colors::kOrange);
  const Point2 home[] = {world.home};
  pictures::draw_points(axes, home, kDot, pictures::colors::kBlue);
  draw_names(axes, world);
}

void draw_operating_area(pictures::Axes& axes, const World& world) {
  axes.add([corners = axes.page(world.operating_area)](pictures::Canvas& canvas) {
    canvas.draw_polygon(corners, 0.8, kArea);
  });
}

void add_world_legend(pictures::Figure& figure, const World& world) {
  const auto holds = [&world](const auto& is_it) {
    return std::any_of(world.solids.begin(), world.solids.end(), is_it);
  };
  const auto holds_kind = [&](SolidKind kind) { return holds([kind](const Solid& s) { return s.kind == kind; }); };
  figure.add_legend(pictures::legend_area("floor", pictures::colors::kFloor, pictures::colors::kGrey));
  if (!world.ceiling.empty())
    figure.add_legend(pictures::legend_area("other ceiling", kHighCeiling, pictures::colors::kGrey));
  figure.add_legend(pictures::legend_area("wall", kWall));
  if (holds([](const Solid& s) { return s.kind == SolidKind::furniture && is_seen_by_laser(s); }))
    figure.add_legend(pictures::legend_area("furniture", kWood, kEdge));
  if (holds(is_low)) figure.add_legend(pictures::legend_area("furniture below the lasers", kLowWood, kEdge));
  if (holds([](const Solid& s) { return s.movable; })) {
    figure.add_legend({"may have been moved", [](pictures::Canvas& canvas) {
                         const Point2 corners[] = {{-9.0, -4.5}, {9.0, -4.5}, {9.0, 4.5}, {-9.0, 4.5}};
                         canvas.draw_polygon(corners, kThickLine, kEdge);
                       }});
  }
  if (holds_kind(SolidKind::glass)) figure.add_legend(pictures::legend_area("glass", kGlass, kGlassEdge));
  if (holds_kind(SolidKind::plate)) figure.add_legend(pictures::legend_area("plate", kPlate, kEdge));
  if (holds_kind(SolidKind::stairs)) figure.add_legend(pictures::legend_area("stairs", kStairs, kEdge));
  figure.add_legend(pictures::legend_line("operating area of the robot's centre", 0.8, kArea));
  if (!world.attractions.empty())
    figure.add_legend(pictures::legend_ring("people like to stand within", 9.0, kLine, pictures::colors::kViolet));
  if (!world.entrances.empty()) figure.add_legend(pictures::legend_disc("entrance", kDot, pictures::colors::kOrange));
  figure.add_legend(pictures::legend_disc("home", kDot, pictures::colors::kBlue));
}

pictures::Figure draw_world(const World& world) {
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
  pictures::Figure figure{"True world"};
  draw_world(figure.add(pictures::Axes::metres(low - Point2{0.5, 0.5}, high + Point2{0.5, 0.5})), world);
  add_world_legend(figure, world);
  return figure;
}

void draw_survey(pictures::Axes& axes, const Survey& survey) {
  pictures::draw_map(axes, survey.map);
  for (const auto& hazard : survey.hazards) pictures::draw_area(axes, hazard.polygon, kHazard);
}

void add_survey_legend(pictures::Figure& figure, const Survey& survey) {
  pictures::add_map_legend(figure);
  if (!survey.hazards.empty()) figure.add_legend(pictures::legend_of_area("hazard", kHazard));
}

pictures::Figure draw_survey(const Survey& survey) {
  pictures::Figure figure{"Survey"};
  draw_survey(figure.add(pictures::Axes::metres(survey.map.frame)), survey);
  add_survey_legend(figure, survey);
  return figure;
}

}  // namespace docent::simulator
