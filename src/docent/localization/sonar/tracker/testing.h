#pragma once

#include <algorithm>
#include <cmath>

#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/localization/sonar/tracker/sweep_match.h"

/// Worlds and echoes for the tests of this folder.
namespace docent::localization::testing {

/// A room of 8 x 5 m round (0, 0) with a pillar, turned by `turn` and drawn with a resolution of 5 cm.
struct TurnedRoom {
  Pose2 map_from_room;
  std::vector<Segment> walls;  ///< [m], map
  OccupancyGrid map;

  explicit TurnedRoom(double turn_degrees) : map_from_room{0.3, -0.2, Angle::degrees(turn_degrees)} {
    add({{-4.0, -2.5}, {4.0, -2.5}, {4.0, 2.5}, {-4.0, 2.5}});
    add({{1.0, 0.9}, {1.6, 0.9}, {1.6, 2.5}, {1.0, 2.5}});
    add({{-2.5, -2.5}, {-1.7, -2.5}, {-1.7, -1.9}, {-2.5, -1.9}});
    map.frame = {240, 240, 0.05, {-6.0, -6.0}};
    map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
    for (int row = 0; row < 240; ++row) {
      for (int column = 0; column < 240; ++column) {
        const Point2 centre = map.frame.centre({column, row});
        const Point2 in_room = inverse(map_from_room) * centre;
        const bool outside = std::abs(in_room.x) > 4.1 || std::abs(in_room.y) > 2.6;
        const bool wall = std::any_of(walls.begin(), walls.end(),
                                      [&](const Segment& side) { return distance(side, centre) <= 0.025; });
        std::int8_t& cell = map.cells[map.frame.index({column, row})];
        if (outside) cell = OccupancyGrid::kUnknown;
        if (wall) cell = OccupancyGrid::kOccupied;
      }
    }
  }

  /// What a sonar hears of smooth walls: the nearest point in a cone of 15 degrees to each side, or nothing.
  [[nodiscard]] double hear(const Pose2& map_from_sonar) const {
    double nearest = 5.0;
    for (const Segment& wall : walls) {
      for (const Point2 point : {nearest_point(wall, map_from_sonar.position()), wall.a, wall.b}) {
        const double off = (direction(map_from_sonar.position(), point) - map_from_sonar.theta).degrees();
        if (std::abs(off) > 15.0) continue;
        nearest = std::min(nearest, distance(map_from_sonar.position(), point));
      }
    }
    return nearest;
  }

  /// The ring at one place.
  [[nodiscard]] std::vector<PlacedEcho> sweep(const Pose2& map_from_robot, const Pose2& robot_from_then = {}) const {
    std::vector<PlacedEcho> echoes;
    for (int i = 0; i < 24; ++i) {
      const Angle bearing = Angle::degrees(15.0 * i);
      const Point2 place = 0.25 * unit(bearing);
      const Pose2 robot_from_sonar = robot_from_then * Pose2{place.x, place.y, bearing};
      const double range = hear(map_from_robot * robot_from_sonar);
      if (range < 4.9) echoes.push_back({robot_from_sonar, range});
    }
    return echoes;
  }

 private:
  void add(const Polygon& in_room) {
    Polygon polygon;
    for (const Point2 corner : in_room) polygon.push_back(map_from_room * corner);
    for (const Segment& side : sides(polygon)) walls.push_back(side);
  }
};

}  // namespace docent::localization::testing
