#include "docent/collision_avoidance/avoider/surroundings.h"

#include <algorithm>
#include <cmath>

#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {

double Surroundings::reach(double speed) const {
  const double until = until_it_stands(speed);
  return std::max(params_.least_reach, limits_.radius + 0.5 * speed * until + params_.fast_walk * until);
}

double Surroundings::steps_in(double speed) const {
  const double way = speed * limits_.hold() + speed * speed / (2.0 * limits_.deceleration);
  return std::max(params_.least_steps_in, limits_.radius + way + params_.surprise * until_it_stands(speed));
}

Point2 Surroundings::stopped_at_outline(Point2 at, Point2 velocity) const {
  const double speed = norm(velocity);
  for (double back = 0.0; speed > 0.0 && back < params_.farthest_inside; back += params_.outline_step) {
    const Point2 before = at - (back / speed) * velocity;
    if (limits_.gap_to(before) >= 0.0) return before;
  }
  return limits_.edge(Angle::radians(std::atan2(at.y, at.x)));
}

void Surroundings::add_sensed(std::vector<Obstacle>& obstacles, const Pose2& base_from_odom, Time when, double speed,
                              const PeopleCaution& caution) const {
  const PointTransform of_points{base_from_odom};
  const UnmappedPlaces* unmapped = unmapped_.judge(when) ? &unmapped_ : nullptr;
  const double reach = this->reach(speed);
  const double steps_in = this->steps_in(speed);
  const std::vector<ObstaclePoint> points = memory_.points(when);
  obstacles.reserve(points.size());
  for (const auto& point : points) {
    Point2 at = of_points * point.in_odom;
    const Point2 velocity = of_points * point.velocity - base_from_odom.position();
    if (limits_.gap_to(at) < 0.0) at = stopped_at_outline(at, velocity);
    const double away = norm(at);
    if (away > reach) continue;
    obstacles.push_back(caution.obstacle_of({point, at, velocity, away, steps_in, unmapped}));
  }
}

void Surroundings::add_felt(std::vector<Obstacle>& obstacles, const Pose2& odom_from_base, double reach) const {
  for (Point2 at : felt_.outlines(odom_from_base, reach)) {
    if (limits_.gap_to(at) < 0.0) at = limits_.edge(Angle::radians(std::atan2(at.y, at.x)));
    obstacles.push_back({.at = at, .margin = params_.real_margin});
    obstacles.back().is_low = true;
  }
}

void Surroundings::add_unseen(std::vector<Obstacle>& obstacles, const Pose2& odom_from_base, Time when) const {
  const double margin = params_.real_margin;
  for (const double bearing : memory_.blind_directions()) {
    // Nobody knows what is there: as if something were just within the margin, wherever the robot is.
    const Point2 at = limits_.edge(Angle::radians(bearing), margin - params_.blind_inset);
    obstacles.push_back({.at = at, .margin = margin});
  }
  for (const Point2 at : seen_.unknown(odom_from_base, limits_, margin, when)) {
    obstacles.push_back({.at = at, .margin = margin});
    obstacles.back().is_unknown = true;
  }
}

std::vector<Obstacle> Surroundings::obstacles(const Pose2& odom_from_base, Time when, double speed,
                                              const PeopleCaution& caution) const {
  std::vector<Obstacle> result;
  const Pose2 base_from_odom = inverse(odom_from_base);
  if (!params_.blind_to_people) {
    add_sensed(result, base_from_odom, when, speed, caution);
    add_felt(result, odom_from_base, reach(speed));
    if (params_.has_lasers) add_unseen(result, odom_from_base, when);
  }
  virtual_.add_to(result, base_from_odom, reach(speed));
  return result;
}

}  // namespace docent::collision_avoidance
