#include "scenery.h"

#include <algorithm>
#include <numbers>

#include "docent/messages/conversions.h"

namespace docent::stage {
namespace {
std::vector<Polygon> hazards_of(const museum::Museum& museum) {
  std::vector<Polygon> polygons;
  for (const auto& hazard : museum.hazards) polygons.push_back(hazard.polygon);
  return polygons;
}
}  // namespace

Scenery::Scenery(const museum::Museum& museum, int people, Rng rng)
    : museum_{museum}, rng_{rng}, planner_{museum.map, hazards_of(museum), museum.area, {}} {
  for (int i = 0; i < people; ++i) {
    Walker walker;
    walker.id = static_cast<std::uint32_t>(i + 1);
    walker.at = any_place();
    walkers_.push_back(walker);
  }
}

Point2 Scenery::any_place() {
  const auto& frame = museum_.map.frame;
  for (int i = 0; i < 10000; ++i) {
    const Point2 place = {frame.origin.x + rng_.uniform() * frame.columns * frame.resolution,
                          frame.origin.y + rng_.uniform() * frame.rows * frame.resolution};
    if (contains(museum_.area, place) && !planner_.is_closed(place)) return place;
  }
  return museum_.home.position();
}

std::vector<Point2> Scenery::way(Point2 from, Point2 to) {
  planner_.set_goal(to, 0.3);
  while (!planner_.iterate(1000)) {
  }
  return planner_.way(from);
}

void Scenery::step(double dt, Point2 robot) {
  for (auto& walker : walkers_) {
    walker.velocity = {};
    if (walker.pause_s > 0.0) {
      walker.pause_s -= dt;
      continue;
    }
    if (walker.way.empty()) {
      // Near enough that the way is short to plan and the hall stays evenly filled.
      const Point2 goal = rng_.chance(0.3) ? robot : any_place();
      walker.way = way(walker.at, goal);
      walker.pause_s = rng_.uniform(1.0, 12.0);
      if (walker.way.size() > 4) walker.way.resize(walker.way.size() - 4);
      continue;
    }
    const Point2 next = walker.way.front();
    const double left = distance(walker.at, next);
    if (left < 0.1) {
      walker.way.erase(walker.way.begin());
      continue;
    }
    if (const double near = distance(walker.at, robot); near < 0.9) {  // makes room
      const Point2 aside = walker.at + (0.7 * dt / std::max(near, 0.01)) * (walker.at - robot);
      if (planner_.is_closed(aside)) {
        walker.pause_s = 0.5;
      } else {
        walker.velocity = (1.0 / dt) * (aside - walker.at);
        walker.at = aside;
      }
      continue;
    }
    walker.velocity = (0.7 / left) * (next - walker.at);
    walker.at = walker.at + dt * walker.velocity;
  }
}

double Scenery::range(Point2 from, Angle bearing) const {
  constexpr double kReach = 10.0;
  const Point2 ray = unit(bearing);
  double reach = kReach;
  for (const auto& walker : walkers_) {
    if (const auto hit = ray_distance(from, ray, walker.at, 0.22)) reach = std::min(reach, *hit);
  }
  const double step = museum_.map.frame.resolution / 2.0;
  for (double s = 0.3; s < reach; s += step) {
    if (museum_.map.is_occupied(museum_.map.frame.cell_at(from + s * ray))) return s;
  }
  return reach;
}

bool Scenery::sees(Point2 from, Point2 to) const {
  const double far = distance(from, to);
  if (far > 9.0) return false;
  const Point2 ray = unit(direction(from, to));
  for (double s = 0.3; s < far - 0.3; s += 0.05) {
    if (museum_.map.is_occupied(museum_.map.frame.cell_at(from + s * ray))) return false;
  }
  return true;
}

sensor_msgs::LaserScan Scenery::scan(const Pose2& map_from_sensor, Time now) {
  sensor_msgs::LaserScan scan;
  scan.header.stamp = to_message(now);
  scan.angle_increment = static_cast<float>(std::numbers::pi / 180.0);
  scan.angle_min = static_cast<float>(-89.5 * std::numbers::pi / 180.0);
  scan.angle_max = static_cast<float>(89.5 * std::numbers::pi / 180.0);
  scan.range_max = 10.0F;
  for (int i = 0; i < 180; ++i) {
    const Angle bearing = map_from_sensor.theta + Angle::degrees(-89.5 + i);
    scan.ranges.push_back(
        static_cast<float>(std::min(10.0, range(map_from_sensor.position(), bearing) + rng_.normal(0.0, 0.015))));
  }
  return scan;
}

}  // namespace docent::stage
