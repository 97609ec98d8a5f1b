#include "docent/simulator/sensing/camera/ceiling/ceiling_design.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "docent/base/random.h"

namespace docent::simulator {
namespace {

constexpr double kPeriod = 3.0;        // [m] of the periodic kind: a lamp each
constexpr double kHighAbove = 2.5;     // [m] above the rest, a part is a hall's roof and no ceiling
constexpr double kLowestSoffit = 2.7;  // [m]
constexpr double kZone = 9.0;          // [m] across: what one switch lights

struct Bounds {
  Point2 low{1e9, 1e9}, high{-1e9, -1e9};
};

Bounds bounds_of(const Polygon& polygon) {
  Bounds b;
  for (const Point2 p : polygon) {
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y)};
  }
  return b;
}

Polygon rectangle(const Pose2& middle, double length, double width) {
  const double l = 0.5 * length, w = 0.5 * width;
  return {middle * Point2{-l, -w}, middle * Point2{l, -w}, middle * Point2{l, w}, middle * Point2{-l, w}};
}

/// Along the longest wall.
Angle main_direction(const Polygon& floor) {
  Segment longest{};
  for (const Segment& side : sides(floor))
    if (distance(side.a, side.b) > distance(longest.a, longest.b)) longest = side;
  return direction(longest.a, longest.b);
}

template <std::size_t N, class T>
T one_of(const std::array<T, N>& choices, Rng& rng) {
  return choices[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(N) - 1))];
}

class Designer {
 public:
  Designer(const World& world, std::uint64_t seed)
      : world_{world},
        rng_{Rng{seed}.stream("ceiling")},
        bounds_{bounds_of(world.floor)},
        area_{std::abs(signed_area(world.floor))},
        axis_{main_direction(world.floor)} {}

  Ceiling various() {
    Rng fields = rng_.stream("fields");
    made_.fields.push_back(field(world_.ceiling_height, fields));
    const Rng rest = rng_.stream("rest");
    add_soffits(rest.stream("soffits"));
    add_skylights(rest.stream("skylights"));
    for (const CeilingPart& part : world_.ceiling) {
      made_.outlines.push_back(part.polygon);
      made_.fields.push_back(field(part.height, fields));
      if (made_.fields.back().covering == Covering::roof) add_roof_lights(part, fields);
    }
    for (std::size_t i = 0; i < made_.fields.size(); ++i) {
      const Rng own = rest.stream("field " + std::to_string(i));
      add_beams(i, own.stream("beams"));
      add_lamps(i, own.stream("lamps"));
    }
    add_spots(rest.stream("spots"));
    return std::move(made_);
  }

  Ceiling even(Covering covering) {
    made_.is_even = true;
    const auto add = [&](double height) {
      CeilingField field;
      field.height = height;
      field.covering = covering;
      made_.fields.push_back(field);
    };
    add(world_.ceiling_height);
    for (const CeilingPart& part : world_.ceiling) {
      made_.outlines.push_back(part.polygon);
      add(part.height);
    }
    if (covering == Covering::periodic) add_periodic_lamps();
    return std::move(made_);
  }

 private:
  CeilingField field(double height, Rng& rng) const {
    constexpr std::array<std::array<double, 2>, 4> kPanels{{{0.6, 0.6}, {0.625, 0.625}, {1.2, 0.6}, {1.2, 0.3}}};
    constexpr std::array<Rgb, 4> kWhites{
        {{0.82F, 0.82F, 0.80F}, {0.74F, 0.75F, 0.76F}, {0.80F, 0.77F, 0.70F}, {0.68F, 0.70F, 0.70F}}};
    constexpr std::array<Rgb, 3> kWoods{{{0.52F, 0.38F, 0.24F}, {0.62F, 0.60F, 0.56F}, {0.40F, 0.27F, 0.17F}}};
    CeilingField made;
    made.height = height;
    made.seed = rng();
    const bool is_high = height > world_.ceiling_height + kHighAbove;
    made.covering = is_high ? Covering::roof : rng.chance(0.75) ? Covering::panels : Covering::plaster;
    made.color = is_high ? one_of(kWoods, rng) : one_of(kWhites, rng);
    const auto size = one_of(kPanels, rng);
    made.length = size[0], made.width = size[1];
    const Angle turned = is_high ? Angle::radians(rng.uniform(0.0, std::numbers::pi)) : axis_;
    made.along = unit(turned);
    made.origin = bounds_.low + Point2{rng.uniform(), rng.uniform()};
    return made;
  }

  [[nodiscard]] Point2 anywhere(Rng& rng) const {
    return {rng.uniform(bounds_.low.x, bounds_.high.x), rng.uniform(bounds_.low.y, bounds_.high.y)};
  }

  /// Dropped parts of plaster or wood, over some of the floor.
  void add_soffits(Rng rng) {
    constexpr std::array<Rgb, 4> kColors{
        {{0.80F, 0.79F, 0.76F}, {0.42F, 0.29F, 0.18F}, {0.30F, 0.31F, 0.33F}, {0.48F, 0.56F, 0.62F}}};
    const int count = static_cast<int>(area_ / 110.0);
    for (int i = 0; i < count; ++i) {
      const double height = world_.ceiling_height - rng.uniform(0.2, 0.5);
      const Point2 at = anywhere(rng);
      const Angle turned = axis_ + Angle::degrees(rng.chance(0.5) ? 0.0 : 90.0) +
                           Angle::degrees(rng.chance(0.25) ? rng.uniform(-45.0, 45.0) : 0.0);
      const Polygon outline = rectangle({at.x, at.y, turned}, rng.uniform(2.0, 6.0), rng.uniform(0.8, 2.5));
      CeilingField made = field(height, rng);
      made.covering = Covering::plaster;
      made.color = one_of(kColors, rng);
      if (height < kLowestSoffit || !contains(world_.floor, at)) continue;
      made_.outlines.push_back(outline);
      made_.fields.push_back(made);
    }
  }

  void add_glazing(const Pose2& at, double length, double width, double height, Rng& rng) {
    CeilingField made;
    made.height = height;
    made.covering = Covering::glazing;
    made.color = {0.95F, 0.98F, 1.0F};
    made.seed = rng();
    made.along = unit(at.theta);
    made.origin = at * Point2{-0.5 * length, -0.5 * width};
    made.length = length / std::ceil(length / 0.8);
    made.width = width / std::ceil(width / 0.8);
    made_.outlines.push_back(rectangle(at, length, width));
    made_.fields.push_back(made);
  }

  void add_skylights(Rng rng) {
    const int count = static_cast<int>(area_ / 130.0);
    for (int i = 0; i < count; ++i) {
      const Point2 at = anywhere(rng);
      const double length = rng.uniform(0.9, 2.8), width = rng.uniform(0.8, 1.6), up = rng.uniform(0.4, 0.9);
      if (contains(world_.floor, at)) add_glazing({at.x, at.y, axis_}, length, width, world_.ceiling_height + up, rng);
    }
  }

  /// Glazing in a high roof, irregular.
  void add_roof_lights(const CeilingPart& part, Rng& rng) {
    const Bounds b = bounds_of(part.polygon);
    const Angle turned = Angle::radians(std::atan2(made_.fields.back().along.y, made_.fields.back().along.x));
    const int count = static_cast<int>(std::abs(signed_area(part.polygon)) / 22.0);
    for (int i = 0; i < count; ++i) {
      const Point2 at{rng.uniform(b.low.x, b.high.x), rng.uniform(b.low.y, b.high.y)};
      const double length = rng.uniform(1.2, 3.6), width = rng.uniform(0.9, 1.8);
      const Pose2 pose{at.x, at.y, turned};
      const Polygon outline = rectangle(pose, length, width);
      if (std::all_of(outline.begin(), outline.end(), [&](Point2 p) { return contains(part.polygon, p); }))
        add_glazing(pose, length, width, part.height + 0.5, rng);
    }
  }

  void add_beams(std::size_t index, Rng rng) {
    const CeilingField field = made_.fields[index];
    const bool is_roof = field.covering == Covering::roof;
    const bool is_main = index == 0;
    if (!is_roof && !(is_main && rng.chance(0.7))) return;
    constexpr Rgb kSteel{0.22F, 0.24F, 0.27F};
    const double depth = is_roof ? rng.uniform(0.5, 0.9) : rng.uniform(0.12, 0.3);
    const double width = is_roof ? rng.uniform(0.15, 0.3) : rng.uniform(0.2, 0.45);
    const Point2 along = !is_roof && rng.chance(0.5) ? Point2{-field.along.y, field.along.x} : field.along;
    const Point2 across{-along.y, along.x};
    const Point2 middle = 0.5 * (bounds_.low + bounds_.high);
    const double reach = 0.5 * distance(bounds_.low, bounds_.high) + 1.0;
    for (double off = -reach + rng.uniform(0.0, 3.0); off < reach;
         off += is_roof ? rng.uniform(2.0, 4.2) : rng.uniform(3.2, 7.0)) {
      const Point2 from = middle + off * across - reach * along;
      const Beam beam{{}, width, field.height, field.height - depth, is_roof ? kSteel : 0.9F * field.color};
      add_runs(index, {from, from + 2.0 * reach * along}, beam);
    }
  }

  /// The pieces of the line that run under a field.
  void add_runs(std::size_t index, const Segment& line, Beam beam) {
    constexpr double kStep = 0.05;  // [m]
    const double length = distance(line.a, line.b);
    const Point2 along = (1.0 / length) * (line.b - line.a);
    double begin = -1.0;
    for (double s = 0.0; s <= length; s += kStep) {
      const Point2 at = line.a + s * along;
      const bool is_under = s + kStep <= length && made_.field_at(at) == index && near_floor(at);
      if (is_under && begin < 0.0) begin = s;
      if (is_under || begin < 0.0) continue;
      beam.axis = {line.a + begin * along, at};
      if (s - begin > 0.3) made_.beams.push_back(beam);
      begin = -1.0;
    }
  }

  [[nodiscard]] bool near_floor(Point2 at) const { return distance(world_.floor, at) < 0.5; }

  [[nodiscard]] int circuit_at(Point2 at) const {
    const auto zone = [](double x) { return std::to_string(static_cast<int>(std::floor(x / kZone))); };
    return static_cast<int>(hash_of(zone(at.x) + ":" + zone(at.y)) % kLampCircuits);
  }

  [[nodiscard]] bool is_over(const Polygon& outline, std::size_t field) const {
    const auto is_there = [&](Point2 p) { return contains(world_.floor, p) && made_.field_at(p) == field; };
    return is_there(0.5 * (outline[0] + outline[2])) && std::all_of(outline.begin(), outline.end(), is_there);
  }

  /// Rows of lamps with gaps, jitter, strangers among them, and some that are dead.
  void add_lamps(std::size_t index, Rng rng) {
    const CeilingField field = made_.fields[index];
    if (field.covering == Covering::glazing) return;
    const bool is_roof = field.covering == Covering::roof;
    constexpr std::array kAll{LampKind::troffer, LampKind::troffer, LampKind::downlight, LampKind::tube,
                              LampKind::globe};
    const LampKind main = is_roof ? LampKind::globe : one_of(kAll, rng);
    const double step_x = rng.uniform(2.2, 3.6), step_y = rng.uniform(2.0, 3.4);
    const double reach = distance(bounds_.low, bounds_.high) + 2.0;
    const Point2 middle = field.to_grid(0.5 * (bounds_.low + bounds_.high));
    for (double x = -reach; x < reach; x += step_x)
      for (double y = -reach; y < reach; y += step_y) {
        Rng own = rng.stream(std::to_string(x) + "," + std::to_string(y));
        const LampKind kind = own.chance(0.8) ? main : is_roof ? LampKind::tube : one_of(kAll, own);
        const Point2 in_grid = middle + Point2{x + own.uniform(-0.6, 0.6), y + own.uniform(-0.6, 0.6)};
        if (own.chance(0.22)) continue;
        const Lamp lamp = lamp_of(kind, field, in_grid, own);
        if (is_over(rectangle(lamp.pose, lamp.length, lamp.width), index)) made_.lamps.push_back(lamp);
      }
  }

  [[nodiscard]] Lamp lamp_of(LampKind kind, const CeilingField& field, Point2 in_grid, Rng& rng) const {
    constexpr std::array<Rgb, 3> kTints{{{1.0F, 0.98F, 0.93F}, {1.0F, 0.90F, 0.74F}, {0.93F, 0.97F, 1.0F}}};
    Lamp lamp;
    lamp.kind = kind;
    lamp.ceiling = field.height;
    lamp.is_dead = rng.chance(0.12);
    lamp.radiance = static_cast<float>(rng.uniform(2.5, 6.0));
    lamp.tint = one_of(kTints, rng);
    double turned = rng.chance(0.2) ? 90.0 : 0.0;
    switch (kind) {
      case LampKind::troffer:  // in the place of whole panels
        lamp.length = field.covering == Covering::panels ? field.length : 1.2;
        lamp.width = field.covering == Covering::panels ? field.width : 0.3;
        in_grid = {(std::floor(in_grid.x / field.length) + 0.5) * field.length,
                   (std::floor(in_grid.y / field.width) + 0.5) * field.width};
        turned = 0.0;
        lamp.height = field.height - 0.006;
        break;
      case LampKind::downlight:
        lamp.length = lamp.width = rng.uniform(0.14, 0.26);
        lamp.height = field.height - 0.006;
        break;
      case LampKind::tube:
        lamp.length = rng.uniform(1.2, 1.9);
        lamp.width = 0.09;
        lamp.height = field.height - rng.uniform(0.3, field.height > 6.0 ? 2.5 : 0.6);
        break;
      case LampKind::globe:
        lamp.length = lamp.width = field.height > 6.0 ? rng.uniform(0.5, 0.8) : rng.uniform(0.25, 0.45);
        lamp.height = field.height - rng.uniform(0.5, field.height > 6.0 ? 2.5 : 0.8);
        break;
    }
    const Point2 at = field.to_world(in_grid);
    lamp.pose = {at.x, at.y, Angle::radians(std::atan2(field.along.y, field.along.x)) + Angle::degrees(turned)};
    lamp.circuit = circuit_at(at);
    return lamp;
  }

  /// A few small lamps round each exhibit.
  void add_spots(Rng rng) {
    for (const Attraction& attraction : world_.attractions) {
      Rng own = rng.stream(attraction.id);
      const auto count = own.integer(0, 4);
      for (std::int64_t i = 0; i < count; ++i) {
        const Point2 at =
            attraction.centre + own.uniform(0.6, 1.9) * unit(Angle::radians(own.uniform(0.0, 2.0 * std::numbers::pi)));
        const std::size_t index = made_.field_at(at);
        if (!contains(world_.floor, at) || made_.fields[index].covering == Covering::glazing) continue;
        made_.lamps.push_back(lamp_of(LampKind::downlight, made_.fields[index], made_.fields[index].to_grid(at), own));
      }
    }
  }

  void add_periodic_lamps() {
    for (double x = std::floor(bounds_.low.x / kPeriod) * kPeriod + 0.9; x < bounds_.high.x; x += kPeriod)
      for (double y = std::floor(bounds_.low.y / kPeriod) * kPeriod + 0.9; y < bounds_.high.y; y += kPeriod) {
        Lamp lamp;
        lamp.pose = {x, y, Angle{}};
        lamp.length = 1.2;
        lamp.ceiling = made_.fields[made_.field_at({x, y})].height;
        lamp.height = lamp.ceiling - 0.006;
        lamp.circuit = circuit_at({x, y});
        made_.lamps.push_back(lamp);
      }
  }

  const World& world_;
  Rng rng_;
  Bounds bounds_;
  double area_;
  Angle axis_;
  Ceiling made_;
};

}  // namespace

std::uint64_t own_seed(const World& world) {
  std::uint64_t seed = hash_of("ceiling");
  for (const Point2 corner : world.floor)
    seed = hash_of(std::to_string(corner.x) + "," + std::to_string(corner.y), seed);
  for (const std::string& exhibit : world.exhibits) seed = hash_of(exhibit, seed);
  return seed;
}

Ceiling design_ceiling(const World& world) {
  Designer designer{world, world.ceiling_style.seed.value_or(own_seed(world))};
  switch (world.ceiling_style.kind) {
    case CeilingKind::various:
      return designer.various();
    case CeilingKind::periodic:
      return designer.even(Covering::periodic);
    case CeilingKind::plain:
      return designer.even(Covering::plain);
  }
  return {};
}

}  // namespace docent::simulator
