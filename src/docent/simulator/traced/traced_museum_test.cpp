#include "docent/simulator/traced/traced_museum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "docent/grid/clearance.h"
#include "docent/simulator/crowd/walkable_floor.h"
#include "docent/simulator/museum_folder/rounds.h"

namespace docent::simulator {
namespace {

/// Two halls of 12 x 12 m at the ends of a corridor 120 m long.
OccupancyGrid long_map() {
  OccupancyGrid map;
  map.frame.resolution = 0.05;
  map.frame.columns = 2920;
  map.frame.rows = 280;
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      const Point2 p = map.frame.centre({column, row});
      const auto is_in = [&](double rim) {
        const bool in_hall = p.y > 1.0 - rim && p.y < 13.0 + rim &&
                             ((p.x > 1.0 - rim && p.x < 13.0 + rim) || (p.x > 133.0 - rim && p.x < 145.0 + rim));
        return in_hall || (p.x > 1.0 - rim && p.x < 145.0 + rim && p.y > 5.0 - rim && p.y < 9.0 + rim);
      };
      if (is_in(0.1))
        map.cells[map.frame.index({column, row})] = is_in(0.0) ? OccupancyGrid::kFree : OccupancyGrid::kOccupied;
    }
  }
  return map;
}

/// A hall of 24 x 16 m with two large cases, some small ones and a side room behind a door.
OccupancyGrid hall_map() {
  OccupancyGrid map;
  map.frame.resolution = 0.05;
  map.frame.origin = {-12.3, 4.7};
  map.frame.columns = 600;
  map.frame.rows = 400;
  map.cells.assign(map.frame.size(), OccupancyGrid::kUnknown);
  const auto fill = [&](double x, double y, double width, double depth, std::int8_t value) {
    for (int row = 0; row < map.frame.rows; ++row) {
      for (int column = 0; column < map.frame.columns; ++column) {
        const double cx = (column + 0.5) * 0.05;
        const double cy = (row + 0.5) * 0.05;
        if (cx > x && cx < x + width && cy > y && cy < y + depth) map.cells[map.frame.index({column, row})] = value;
      }
    }
  };
  fill(0.9, 0.9, 24.2, 16.2, OccupancyGrid::kOccupied);
  fill(1.0, 1.0, 24.0, 16.0, OccupancyGrid::kFree);
  fill(25.0, 8.0, 0.15, 1.2, OccupancyGrid::kFree);  // a door
  fill(25.15, 6.0, 3.5, 5.0, OccupancyGrid::kFree);
  fill(6.0, 6.0, 2.0, 2.0, OccupancyGrid::kOccupied);
  fill(15.0, 9.0, 4.0, 1.2, OccupancyGrid::kOccupied);
  for (int i = 0; i < 5; ++i) fill(5.0 + 3.5 * i, 13.0, 0.8, 0.6, OccupancyGrid::kOccupied);
  fill(12.0, 0.9, 0.3, 0.6, OccupancyGrid::kOccupied);    // a pilaster, twice as wide as walls are thick
  fill(10.0, 3.0, 0.05, 0.05, OccupancyGrid::kOccupied);  // noise
  return map;
}

TracedMuseum traced(std::uint64_t seed, std::span<const Recording> recordings = {}) {
  auto museum = trace_museum(hall_map(), recordings, "hall", seed);
  EXPECT_TRUE(museum) << museum.error().message;
  return std::move(*museum);
}

TEST(TracedMuseum, HasTheFloorOfTheMap) {
  const World world = traced(1).plan.world;
  EXPECT_NEAR(signed_area(world.floor), 24.0 * 16.0 + 3.5 * 5.0, 8.0);
  EXPECT_TRUE(is_simple(world.floor));
  EXPECT_TRUE(contains(world.floor, Point2{-12.3 + 26.5, 4.7 + 8.5})) << "the side room";
  // The large cases stand where they stood.
  for (const Point2 inside : {Point2{7.0, 7.0}, Point2{17.0, 9.6}}) {
    const Point2 point = inside + Point2{-12.3, 4.7};
    EXPECT_TRUE(std::any_of(world.solids.begin(), world.solids.end(),
                            [&](const Solid& solid) { return contains(solid.polygon, point); }));
  }
}

TEST(TracedMuseum, ItsToursAreShortAndVisitEveryStop) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MuseumPlan plan = traced(seed).plan;
    std::set<std::string> visited;
    std::vector<std::string> ids;
    for (const Round& round : plan.rounds) {
      ids.push_back(round.id);
      visited.insert(round.stops.begin(), round.stops.end());
      EXPECT_LE(round.stops.size(), kMostStopsOfARound) << seed;
    }
    EXPECT_GE(plan.rounds.size(), 2U) << seed << ": " << plan.stops.size() << " stops are more than one tour";
    EXPECT_EQ(ids, plan.world.tours) << seed;
    EXPECT_EQ(visited, std::set<std::string>(plan.world.exhibits.begin(), plan.world.exhibits.end())) << seed;
  }
}

TEST(TracedMuseum, ALongBuildingHasItsHomeMidwayAndItsStopsNotFarFromIt) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto museum = trace_museum(long_map(), {}, "long", seed);
    ASSERT_TRUE(museum) << museum.error().message;
    const MuseumPlan& plan = museum->plan;
    EXPECT_NEAR(plan.home.x, 73.0, 12.0) << seed;
    EXPECT_GE(plan.stops.size(), 3U) << seed;
    EXPECT_GT(distance(plan.world.entrances.at(0), plan.world.entrances.at(1)), 120.0) << seed;
    for (const Stop& stop : plan.stops) EXPECT_LE(distance(stop.pose.position(), plan.home.position()), 41.0) << seed;
  }
}

TEST(TracedMuseum, IsASoundWorldWithWhatAMapCannotShow) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MuseumPlan plan = traced(seed).plan;
    const auto world = parse_world(to_yaml(plan.world), "simulation.yaml");
    ASSERT_TRUE(world) << world.error().message;
    std::set<SolidKind> kinds;
    int movable = 0;
    for (const Solid& solid : world->solids) {
      kinds.insert(solid.kind);
      if (solid.movable) ++movable;
    }
    EXPECT_EQ(kinds.size(), 5U) << seed;
    EXPECT_GE(movable, 3) << seed;
    // No ray leaves the building: round the floor there is wall everywhere.
    for (const Segment& side : sides(world->floor)) {
      const Point2 out = (0.05 / distance(side.a, side.b)) * Point2{side.b.y - side.a.y, side.a.x - side.b.x};
      for (const double share : {0.01, 0.5, 0.99}) {
        const Point2 point = side.a + share * (side.b - side.a) + out;
        const bool is_wall = std::any_of(world->solids.begin(), world->solids.end(), [&](const Solid& solid) {
          return solid.kind == SolidKind::wall && distance(solid.polygon, point) < 0.02;
        });
        EXPECT_TRUE(is_wall) << seed << ": " << point.x << ", " << point.y;
      }
    }
  }
}

TEST(TracedMuseum, ARobotReachesItsPlacesAlsoOnTheSurvey) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MuseumPlan plan = traced(seed).plan;
    const WalkableFloor floor{plan.world};
    FlowField field = floor.field_to(plan.home.position(), 0.3);
    ASSERT_GE(plan.stops.size(), 3U);
    ASSERT_TRUE(plan.charger);
    const Survey surveyed = survey(plan.world, {}, Rng{seed});
    std::vector<bool> blocked(surveyed.map.frame.size());
    for (std::size_t i = 0; i < blocked.size(); ++i) blocked[i] = surveyed.map.cells[i] != OccupancyGrid::kFree;
    const auto clearance = distance_transform(surveyed.map.frame, blocked);
    for (const Stop& stop : plan.stops) {
      const Point2 place = stop.pose.position();
      EXPECT_GT(floor.clearance(place), 0.5) << seed << ' ' << stop.id;
      EXPECT_TRUE(floor.direction(field, place, 0.3)) << seed << ' ' << stop.id;
      EXPECT_TRUE(contains(plan.world.operating_area, place));
      EXPECT_LT(distance(place, stop.look_at), 1.6);
      EXPECT_NEAR((direction(place, stop.look_at) - stop.pose.theta).radians(), 0.0, 1e-6);
      EXPECT_GE(clearance[surveyed.map.frame.index(surveyed.map.frame.cell_at(place))], 0.37F) << seed << stop.id;
      for (const SurveyedHazard& hazard : surveyed.hazards) EXPECT_GE(distance(hazard.polygon, place), 0.37);
    }
    EXPECT_FALSE(surveyed.moved.empty());
    EXPECT_FALSE(surveyed.missing.empty());
  }
}

TEST(TracedMuseum, ItsPlacesLeaveTheRoomThatThePlannerAsksFor) {
  constexpr Clearance kNeeded{};
  constexpr double kRobotRadius = 0.265;
  std::size_t hazards = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const MuseumPlan plan = traced(seed).plan;
    std::vector<Point2> places{plan.home.position()};
    if (plan.charger) places.push_back(plan.charger->position());
    for (const Stop& stop : plan.stops) places.push_back(stop.pose.position());
    const Survey surveyed = survey(plan.world, {}, Rng{seed});
    hazards += surveyed.hazards.size();
    for (const Point2 place : places) {
      EXPECT_GE(outline_distance(plan.world.operating_area, place), kNeeded.border) << seed;
      for (const SurveyedHazard& hazard : surveyed.hazards)
        EXPECT_GE(distance(hazard.polygon, place), kRobotRadius + kNeeded.hazards) << seed << ' ' << hazard.id;
    }
  }
  EXPECT_GT(hazards, 6U);
}

TEST(TracedMuseum, IsTheSameForASeed) {
  EXPECT_EQ(to_yaml(traced(3).plan.world), to_yaml(traced(3).plan.world));
  EXPECT_NE(to_yaml(traced(3).plan.world), to_yaml(traced(4).plan.world));
}

TEST(TracedMuseum, NothingStandsWhereRecordedPeopleWalk) {
  Recording recording{"rows", 60.0, {}};
  for (int i = 0; i < 8; ++i) {
    Track track{2.0 * i, {}};
    for (double x = 0.0; x <= 20.0; x += 0.5) track.points.push_back({x, 0.4 * i});
    recording.tracks.push_back(std::move(track));
  }
  const std::vector<Recording> recordings{recording};
  const TracedMuseum museum = traced(2, recordings);
  EXPECT_EQ(museum.fits.at(0).recording.tracks.size(), 8U);
  EXPECT_EQ(museum.plan.world.pedestrians.size(), 1U);
  for (const Solid& solid : museum.plan.world.solids) {
    EXPECT_FALSE(is_walked_on(solid.polygon, museum.plan.world.pedestrians)) << solid.id;
  }
}

TEST(TracedMuseum, SaysWhatCannotWork) {
  OccupancyGrid nothing;
  nothing.frame.columns = nothing.frame.rows = 50;
  nothing.cells.assign(nothing.frame.size(), OccupancyGrid::kUnknown);
  EXPECT_NE(trace_museum(nothing, {}, "x", 1).error().message.find("no open floor of 20 m2"), std::string::npos);
  OccupancyGrid corridor = nothing;
  corridor.frame.columns = 1000;
  corridor.frame.rows = 16;
  corridor.cells.assign(corridor.frame.size(), OccupancyGrid::kFree);
  EXPECT_FALSE(trace_museum(corridor, {}, "x", 1));
}

}  // namespace
}  // namespace docent::simulator
