#include "docent/collision_avoidance/avoider/carrot.h"

#include <algorithm>
#include <cmath>

#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance {

namespace {

/// Where the robot is on the path: the nearest place of it, and the via-point that follows.
struct PathPlace {
  Point2 at;
  std::size_t next = 0;
};

PathPlace nearest_on(std::span<const Point2> path) {
  std::size_t leg = 0;
  Point2 here = path.front();
  double least = norm(path.front());
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point2 near = nearest_point({path[i], path[i + 1]}, {});
    if (norm(near) < least) {
      least = norm(near);
      here = near;
      leg = i;
    }
  }
  return {here, here == path.front() ? 0 : leg + 1};
}

bool is_taken(Point2 place, std::span<const Obstacle> obstacles, double radius) {
  return std::any_of(obstacles.begin(), obstacles.end(),
                     [&](const Obstacle& obstacle) { return distance(obstacle.at, place) < radius; });
}

}  // namespace

Carrot carrot_on(std::span<const Point2> path, double lookahead, std::span<const Obstacle> obstacles, double radius,
                 const CarrotParams& params) {
  const PathPlace here = nearest_on(path);
  Carrot result{here.at, norm(here.at)};
  Point2 at = here.at;
  Point2 end = here.at;
  Point2 nearly = here.at;  // what can be reached by a robot that keeps a little less off
  const double slim = radius - params.nearly_open;
  bool is_inside = true;
  bool is_blocked = false;
  double along = 0.0;
  for (std::size_t next = here.next; next < path.size(); ++next) {
    double rest = distance(at, path[next]);
    while (rest > 1e-9) {
      const double step = std::min(params.step, rest);
      at = at + (step / rest) * (path[next] - at);
      rest -= step;
      along += step;
      const double way = norm(at);
      is_inside = is_inside && way <= lookahead;
      if (!is_inside) continue;
      end = at;
      is_blocked = is_blocked || is_taken(at, obstacles, slim);
      const double bearing = std::atan2(at.y, at.x);
      const auto is_open_for = [&](double body) {
        return straight_free_way(bearing, obstacles, body, way) >= way - params.nearly_free;
      };
      if (is_open_for(radius)) {
        result.in_base = nearly = at;
      } else if (is_open_for(slim)) {
        nearly = at;
      }
    }
  }
  if (norm(result.in_base) < params.here) result.in_base = nearly;
  const double open = norm(result.in_base);
  if (open < params.here || (is_blocked && open < params.open_enough)) result.in_base = end;
  result.remaining += along;
  return result;
}

}  // namespace docent::collision_avoidance
