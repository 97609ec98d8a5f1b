#include "docent/simulator/traced/traced_museum.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "docent/base/random.h"
#include "docent/grid/clearance.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/museum_folder/rounds.h"
#include "docent/simulator/traced/floor_plan.h"
#include "docent/simulator/traced/outlines.h"
#include "docent/simulator/traced/wall_spots.h"

namespace docent::simulator {
namespace {

constexpr double kWallThickness = 0.15;  // [m]
constexpr double kLargestCase = 3.0;     // [m2] of an island; larger ones are parts of the building
constexpr double kLargestMovable = 1.5;  // [m2]
constexpr double kPodium = 0.3;          // [m] too low for the lasers
constexpr double kRim = 0.25;            // [m] of the robot's area from walls
constexpr double kOffStairs = 0.25;      // [m] more, from the edge of stairs
constexpr double kMayMove = 0.4;         // [m] a movable thing may stand elsewhere on the map
constexpr double kPassable = 0.5;        // [m] clearance of the robot's ways from all that stands
constexpr double kRobotRadius = 0.265;   // [m]
constexpr double kSurveyErrs = 0.04;     // [m] by which a survey draws things elsewhere, rounded up
constexpr double kCell = 0.1;            // [m] of the search for places
constexpr double kOpen = 1.1;            // [m] clearance of open floor
constexpr double kToOpen = 1.0;          // [m] from a place where a group can gather to open floor
constexpr double kFarthestStop = 40.0;   // [m] to walk from home: a robot among people takes a minute and a half
constexpr double kNearness = 0.05;       // [1/m] what a home loses with the way to the farther end of the building

/// A convex outline round the polygon that keeps `by` [m] from it: its bounding box, grown.
Polygon grown_box(const Polygon& polygon, double by) {
  Point2 low = polygon.front();
  Point2 high = low;
  for (const Point2 p : polygon) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {{low.x - by, low.y - by}, {high.x + by, low.y - by}, {high.x + by, high.y + by}, {low.x - by, high.y + by}};
}

Point2 left_of(Point2 direction) { return {-direction.y, direction.x}; }

Point2 nearest_on(const Polygon& polygon, Point2 point) {
  Point2 best = polygon.front();
  for (const Segment& side : sides(polygon)) {
    const Point2 candidate = nearest_point(side, point);
    if (distance(candidate, point) < distance(best, point)) best = candidate;
  }
  return best;
}

/// One wall along each side of the outline, outside of it; mitred, so that corners close.
std::vector<Polygon> walls_round(const Polygon& outline) {
  const std::size_t count = outline.size();
  std::vector<Point2> outwards;  // of each side
  for (const Segment& side : sides(outline)) {
    outwards.push_back(-1.0 / distance(side.a, side.b) * left_of(side.b - side.a));
  }
  const auto mitre = [&](std::size_t corner) {
    const Point2 before = outwards[(corner + count - 1) % count];
    const Point2 sum = before + outwards[corner];
    // Of a sharp corner the mitre is cut.
    const double share = 2.0 / std::max(dot(sum, sum), 1.0);
    return to_millimetre(outline[corner] + (kWallThickness * share) * sum);
  };
  std::vector<Polygon> walls;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    Polygon wall{outline[i], mitre(i), mitre(j), outline[j]};
    if (!is_simple(wall) || signed_area(wall) < 1e-4) {
      const Point2 off = kWallThickness * outwards[i];
      wall = {outline[i], to_millimetre(outline[i] + off), to_millimetre(outline[j] + off), outline[j]};
    }
    walls.push_back(std::move(wall));
  }
  return walls;
}

/// How far it is to walk from a point to the goal [m]; straight on where nobody can walk.
class WayTo {
 public:
  WayTo(const WalkableFloor& floor, Point2 goal) : floor_{&floor}, goal_{goal}, field_{floor.field_to(goal, 0.3)} {}
  double operator()(Point2 point) { return floor_->way(field_, point).value_or(distance(goal_, point)); }

 private:
  const WalkableFloor* floor_;
  Point2 goal_;
  FlowField field_;
};

/// Chooses what stands where.
class Curator {
 public:
  Curator(FloorPlan floor_plan, const std::optional<Places>& places, std::uint64_t seed)
      : traced_{std::move(floor_plan)}, places_{places}, rng_{Rng{seed}.stream("curator")} {}

  Result<TracedMuseum> make(std::span<const Recording> recordings) {
    World& world = plan_.world;
    world.floor = traced_.floor;
    build_walls();
    world.entrances = {interior_point()};
    world.home = world.entrances.front();
    let_people_walk(recordings);
    set_up_islands();
    furnish();
    world.operating_area = trace_area(traced_, stairs_, kRim, 0.5 * kRim);
    if (!find_places()) return fail("the map has no room for a home and two exhibits that a robot reaches");
    museum_.frame = traced_.frame;
    museum_.building = std::move(traced_.building);
    return std::move(museum_);
  }

 private:
  void add(const std::string& name, SolidKind kind, Polygon polygon, double top, bool movable = false) {
    const std::string id = name + "-" + std::to_string(++count_);
    plan_.world.solids.push_back({id, kind, std::move(polygon), 0.0, top, movable});
  }
  /// A case that lasers see through, on a podium that is too low for them.
  void add_glass_case(const Polygon& polygon) {
    add("podium", SolidKind::furniture, polygon, kPodium);
    add("glass", SolidKind::glass, polygon, 1.9);
  }

  void build_walls() {
    for (Polygon& wall : walls_round(traced_.floor)) add("wall", SolidKind::wall, std::move(wall), 3.0);
    for (const Polygon& island : traced_.islands) {
      if (signed_area(island) > kLargestCase) add("block", SolidKind::wall, island, 3.0);
    }
  }

  void let_people_walk(std::span<const Recording> recordings) {
    if (recordings.empty()) return;
    const WalkableFloor floor{plan_.world};
    for (const Recording& recording : recordings) {
      museum_.fits.push_back(fit_pedestrians(recording, floor));
      plan_.world.pedestrians.push_back(museum_.fits.back().recording);
    }
  }

  void set_up_islands() {
    Rng rng = rng_.stream("islands");
    for (const Polygon& island : traced_.islands) {
      const double area = signed_area(island);
      if (area > kLargestCase) continue;
      if (is_walked_on(island, plan_.world.pedestrians)) {
        ++museum_.carried_away;
      } else if (!places_ && area > 0.2 && rng.chance(0.2)) {
        add_glass_case(island);
      } else {
        const bool is_movable = area > 0.05 && area < kLargestMovable && rng.chance(0.5);
        add("case", SolidKind::furniture, island, rng.uniform(0.8, 2.0), is_movable);
      }
    }
  }

  /// A point well inside the largest part of the floor, for the floor to know which part counts.
  [[nodiscard]] Point2 interior_point() const {
    World world = plan_.world;
    Point2 best = traced_.floor.front();
    double most = 0.0;
    const WalkableFloor floor{world};
    for_cells([&](Point2 point) {
      const double clearance = floor.clearance(point);
      if (clearance <= most) return;
      most = clearance;
      best = point;
    });
    return best;
  }

  void put_hazards() {
    for (const Solid& hazard : places_->hazards) {
      plan_.world.solids.push_back(hazard);
      if (hazard.kind == SolidKind::stairs) stairs_.push_back(grown_box(hazard.polygon, kOffStairs));
    }
  }

  void furnish() {
    const WalkableFloor floor{plan_.world};
    WallSpots spots{traced_.floor, floor, rng_.stream("spots")};
    const auto put = [&](double width, double depth, auto&& use) {
      const auto is_free = [&](const Polygon& box) { return !is_walked_on(box, plan_.world.pedestrians); };
      if (const auto box = spots.place(width, depth, 4.0, is_free)) use(*box);
    };
    if (places_) {
      put_hazards();
    } else {
      put(2.0, 1.4, [&](const Polygon& box) {
        plan_.world.solids.push_back({"stairs", SolidKind::stairs, box, 0.0, 0.0, false});
        stairs_.push_back(grown_box(box, kOffStairs));
      });
      for (int i = 0; i < 2; ++i) {
        put(1.6, 0.7, [&](const Polygon& box) { add_glass_case(box); });
        put(1.2, 0.6, [&](const Polygon& box) { add("plate", SolidKind::plate, box, 0.02); });
      }
    }
    for (int i = 0; i < 4; ++i) {
      put(1.4, 0.45, [&](const Polygon& box) { add("bench", SolidKind::furniture, box, 0.45, true); });
    }
  }

  /// Calls f with the points of a lattice over the floor's bounding box.
  template <class F>
  void for_cells(F&& f) const {
    const Polygon box = grown_box(traced_.floor, 0.0);
    for (double y = box[0].y + 0.5 * kCell; y < box[2].y; y += kCell) {
      for (double x = box[0].x + 0.5 * kCell; x < box[2].x; x += kCell) f(Point2{x, y});
    }
  }

  struct Place {
    Point2 point;
    double clearance = 0.0;  ///< [m] also from where movable things may be drawn
    bool has_room = false;   ///< for a group: open floor is near
  };

  /// Where a robot can stand and drive to the rest, by the world in which everything movable is as broad as it may be.
  [[nodiscard]] std::vector<Place> reachable_places() const {
    World cautious = plan_.world;
    for (Solid& solid : cautious.solids) {
      if (solid.movable) solid.polygon = grown_box(solid.polygon, kMayMove);
    }
    const WalkableFloor floor{cautious};
    GridFrame frame;
    const Polygon box = grown_box(traced_.floor, 0.0);
    frame.resolution = kCell;
    frame.origin = box[0];
    frame.columns = static_cast<int>((box[2].x - box[0].x) / kCell) + 1;
    frame.rows = static_cast<int>((box[2].y - box[0].y) / kCell) + 1;
    std::vector<bool> open(frame.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Point2 point = centre_of(frame, i);
      open[i] = floor.clearance(point) >= kPassable && leaves_room(point);
    }
    const std::vector<int> labels = label_regions(frame, open);
    std::vector<std::size_t> sizes(static_cast<std::size_t>(*std::max_element(labels.begin(), labels.end())) + 1, 0);
    for (const int label : labels) {
      if (label > 0) ++sizes[static_cast<std::size_t>(label)];
    }
    const auto best = static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    std::vector<bool> is_wide(frame.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      is_wide[i] = open[i] && labels[i] == best && floor.clearance(centre_of(frame, i)) >= kOpen;
    }
    const std::vector<float> to_open = distance_transform(frame, is_wide);
    std::vector<Place> places;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Point2 point = centre_of(frame, i);
      if (!open[i] || labels[i] != best) continue;
      places.push_back({point, floor.clearance(point), static_cast<double>(to_open[i]) <= kToOpen});
    }
    return places;
  }
  /// What the planner asks of the robot's place, beside walls: room to hazards and to the border of its area.
  [[nodiscard]] bool leaves_room(Point2 point) const {
    constexpr Clearance kNeeded{};
    const World& world = plan_.world;
    if (!contains(world.operating_area, point)) return false;
    if (outline_distance(world.operating_area, point) < kNeeded.border + kSurveyErrs) return false;
    return std::all_of(world.solids.begin(), world.solids.end(), [&](const Solid& solid) {
      const double moved = solid.movable ? kMayMove : 0.0;
      return is_seen_by_laser(solid) ||
             distance(solid.polygon, point) >= kRobotRadius + kNeeded.hazards + kSurveyErrs + moved;
    });
  }
  [[nodiscard]] static Point2 centre_of(const GridFrame& frame, std::size_t index) {
    const auto columns = static_cast<std::size_t>(frame.columns);
    return frame.centre({static_cast<int>(index % columns), static_cast<int>(index / columns)});
  }

  /// The place with the greatest value; nullopt where none has one above 0.
  template <class F>
  [[nodiscard]] static std::optional<Point2> best_place(const std::vector<Place>& places, F&& value) {
    std::optional<Point2> best;
    double most = 0.0;
    for (const Place& place : places) {
      const double worth = value(place);
      if (worth <= most) continue;
      most = worth;
      best = place.point;
    }
    return best;
  }

  bool find_places() {
    World& world = plan_.world;
    const std::vector<Place> places = reachable_places();
    if (places.empty()) return false;
    // People enter at the ends of the building, which are as far apart as can be; the robot waits midway between them.
    const WalkableFloor floor{world};
    const auto far_from = [&](Point2 point) {
      return best_place(places, [way = WayTo{floor, point}](const Place& p) mutable {
        return p.clearance >= 0.8 && p.has_room ? way(p.point) : 0.0;
      });
    };
    const auto first = far_from(places.front().point);
    const auto second = first ? far_from(*first) : std::nullopt;
    if (!second) return false;
    world.entrances = {*second, *first};
    const auto home =
        best_place(places, [one = WayTo{floor, *first}, other = WayTo{floor, *second}](const Place& p) mutable {
          const double farther = std::max(one(p.point), other(p.point));
          return p.has_room ? std::min(p.clearance, 1.4) / (1.0 + kNearness * farther) : 0.0;
        });
    if (!home && !(places_ && places_->home)) return false;
    plan_.home = places_ && places_->home ? *places_->home : Pose2{home->x, home->y, direction(*home, *first)};
    world.home = plan_.home.position();
    const auto charger = best_place(places, [&](const Place& p) {
      const double away = distance(p.point, world.home);
      return is_beside(p) && away > 1.5 ? 1.0 / away : 0.0;
    });
    if (charger) plan_.charger = Pose2{charger->x, charger->y, direction(nearest_thing(*charger), *charger)};
    if (places_) {
      if (places_->charger) plan_.charger = places_->charger;
      plan_.languages = places_->languages;
      for (const Stop& stop : places_->stops) show(stop);
    } else {
      choose_stops(places, floor);
    }
    return plan_.stops.size() >= 2;
  }

  /// Near enough to something to show it, with room for those who listen.
  [[nodiscard]] static bool is_beside(const Place& place) {
    return place.has_room && place.clearance >= 0.6 && place.clearance <= 0.9;
  }

  /// On the outline of what stands nearest.
  [[nodiscard]] Point2 nearest_thing(Point2 point) const {
    Point2 best{};
    double least = 1e9;
    for (const Solid& solid : plan_.world.solids) {
      if (solid.kind == SolidKind::plate || solid.kind == SolidKind::stairs || solid.movable) continue;
      const Point2 candidate = nearest_on(solid.polygon, point);
      if (distance(candidate, point) >= least) continue;
      least = distance(candidate, point);
      best = candidate;
    }
    return best;
  }

  /// One after the other, each as far as can be from home and from those before, but none so far that those who ask for
  /// it wait for long.
  void choose_stops(std::vector<Place> places, const WalkableFloor& floor) {
    std::erase_if(places, [home = WayTo{floor, plan_.home.position()}](const Place& p) mutable {
      return home(p.point) > kFarthestStop;
    });
    const double square_metres = static_cast<double>(places.size()) * kCell * kCell;
    const auto wanted = static_cast<std::size_t>(std::clamp(square_metres / 40.0, 3.0, 16.0));
    std::vector<Point2> chosen{plan_.home.position()};
    while (plan_.stops.size() < wanted) {
      const auto place = best_place(places, [&](const Place& p) {
        if (!is_beside(p)) return 0.0;
        double least = 1e9;
        for (const Point2 other : chosen) least = std::min(least, distance(other, p.point));
        return least - 2.0;
      });
      if (!place) break;
      chosen.push_back(*place);
      const Point2 thing = nearest_thing(*place);
      const std::string id = "exhibit-" + std::to_string(plan_.stops.size() + 1);
      show({id, {place->x, place->y, direction(*place, thing)}, thing, {}, {}});
    }
  }

  void show(const Stop& stop) {
    plan_.stops.push_back(stop);
    plan_.world.exhibits.push_back(stop.id);
    plan_.world.attractions.push_back({stop.id, stop.look_at, 1.5, 1.0});
  }

  FloorPlan traced_;
  const std::optional<Places>& places_;
  Rng rng_;
  TracedMuseum museum_;
  MuseumPlan& plan_{museum_.plan};
  std::vector<Polygon> stairs_;  ///< with the room that the robot keeps
  int count_ = 0;
};

/// How far it is to walk from home and each stop to the others [m].
std::vector<std::vector<double>> ways_between(const MuseumPlan& plan) {
  const WalkableFloor floor{plan.world};
  std::vector<Point2> places{plan.home.position()};
  for (const Stop& stop : plan.stops) places.push_back(stop.pose.position());
  std::vector<std::vector<double>> ways(places.size(), std::vector<double>(places.size(), 0.0));
  for (std::size_t from = 0; from < places.size(); ++from) {
    WayTo way{floor, places[from]};
    for (std::size_t to = 0; to < from; ++to) ways[from][to] = ways[to][from] = way(places[to]);
  }
  return ways;
}

/// Tours through the stops, which were chosen as far apart as can be.
void add_rounds(MuseumPlan& plan) {
  const auto rounds = rounds_of(ways_between(plan));
  for (const auto& round : rounds) {
    const std::string number = std::to_string(plan.rounds.size() + 1);
    const std::string of_all = rounds.size() > 1 ? ", part " + number + " of " + std::to_string(rounds.size()) : "";
    Round tour{rounds.size() > 1 ? "round-" + number : "round", "Round the floor" + of_all, {}};
    for (const std::size_t stop : round) tour.stops.push_back(plan.stops[stop].id);
    plan.world.tours.push_back(tour.id);
    plan.rounds.push_back(std::move(tour));
  }
}

}  // namespace

Result<TracedMuseum> trace_museum(const OccupancyGrid& map, std::span<const Recording> recordings,
                                  const std::string& title, std::uint64_t seed, const std::optional<Places>& places) {
  auto floor_plan = trace_floor(map, {});
  if (!floor_plan) return tl::unexpected<Error>(floor_plan.error());
  auto museum = Curator{std::move(*floor_plan), places, seed}.make(recordings);
  if (!museum) return museum;
  MuseumPlan& plan = museum->plan;
  plan.title = title;
  plan.made_of = "Traced from a map, furnished and surveyed with seed " + std::to_string(seed);
  plan.topic = "rooms";
  add_rounds(plan);
  if (!recordings.empty()) plan.world.pedestrians_file = "pedestrians.txt";
  return museum;
}

}  // namespace docent::simulator
