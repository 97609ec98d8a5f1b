#include "docent/collision_avoidance/body/outline_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "docent/geometry/convex.h"

namespace docent::collision_avoidance {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kTurn = 2.0 * std::numbers::pi;

Point2 turned_left(Point2 a) { return {-a.y, a.x}; }

}  // namespace

Result<Outline> Outline::make(Polygon corners) {
  if (corners.size() < 3) return fail("body.outline needs at least three corners");
  if (signed_area(corners) < 0.0) std::reverse(corners.begin(), corners.end());
  if (!is_convex(corners)) return fail("body.outline must be convex, without corners on a straight line");
  if (!holds_inside(corners, {})) return fail("body.outline must hold the robot's centre");
  Outline outline;
  for (const Point2& corner : corners) outline.circumradius_ = std::max(outline.circumradius_, norm(corner));
  outline.corners_ = std::move(corners);
  return outline;
}

Result<Outline> Outline::of_body(std::span<const std::vector<double>> corners) {
  if (corners.empty()) return Outline{};
  Polygon polygon;
  for (const auto& corner : corners) {
    if (corner.size() != 2) return fail("body.outline must be a list of corners [x, y]");
    polygon.push_back({corner[0], corner[1]});
  }
  return make(std::move(polygon));
}

double Outline::radius_at(Angle bearing) const {
  double least = kNever;
  for (const auto& side : sides(corners_))
    least = std::min(least, ray_distance({}, unit(bearing), side).value_or(kNever));
  return std::min(least, circumradius_);  // a ray that slips between two sides meets their corner
}

Point2 Outline::nearest(Point2 point) const {
  Point2 nearest = corners_.front();
  double least = kNever;
  for (const auto& side : sides(corners_)) {
    const Point2 foot = nearest_point(side, point);
    const double away = distance(foot, point);
    if (away < least) {
      least = away;
      nearest = foot;
    }
  }
  return nearest;
}

Point2 Outline::outwards(Point2 point) const {
  const Point2 foot = nearest(point);
  // Inside, the way out is past the nearest side.
  const Point2 away = contains(corners_, point) ? foot - point : point - foot;
  const double length = norm(away);
  return length > 0.0 ? (1.0 / length) * away : Point2{};
}

double Outline::closing_speed(double linear, double angular, Point2 point) const {
  // Seen from the robot it is the point that moves.
  return dot(Point2{linear, 0.0} + angular * turned_left(point), outwards(point));
}

double Outline::arc_distance(double curvature, Point2 point, double margin) const {
  // Seen from the robot the point moves backwards, and about the centre of the turn against it.
  if (distance_to(point) <= margin) return closing_speed(1.0, curvature, point) > 0.0 ? 0.0 : kNever;
  if (std::abs(curvature) < 1e-6) return straight_contact(point, margin);
  const double angle = first_contact({0.0, 1.0 / curvature}, curvature > 0.0 ? -1.0 : 1.0, point, margin);
  return angle / std::abs(curvature);
}

double Outline::first_contact(Point2 pivot, double side, Point2 point, double margin) const {
  const Point2 from_pivot = point - pivot;
  const double radius = norm(from_pivot);
  const double start = std::atan2(from_pivot.y, from_pivot.x);
  double least = kNever;
  const auto meet = [&](double bearing) {
    double angle = std::fmod(side * (bearing - start), kTurn);
    if (angle < 0.0) angle += kTurn;
    least = std::min(least, angle);
  };
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2 a = corners_[i];
    const Point2 along = corners_[(i + 1) % corners_.size()] - a;
    const double length = norm(along);
    const Point2 outwards = (-1.0 / length) * turned_left(along);
    // The side, moved outwards: the circle meets its line at two bearings about the line's normal.
    const double away = dot(a - pivot, outwards) + margin;
    if (std::abs(away) <= radius) {
      const double normal = std::atan2(outwards.y, outwards.x);
      const double half = std::acos(std::clamp(away / radius, -1.0, 1.0));
      for (const double bearing : {normal - half, normal + half}) {
        const Point2 at = pivot + radius * unit(Angle::radians(bearing));
        const double place = dot(at - a, along) / length;
        if (place >= 0.0 && place <= length) meet(bearing);
      }
    }
    // The margin's circle about the corner.
    const Point2 corner = a - pivot;
    const double to_corner = norm(corner);
    if (margin > 0.0 && to_corner > 0.0 && std::abs(radius - to_corner) <= margin) {
      const double cosine = (radius * radius + to_corner * to_corner - margin * margin) / (2.0 * radius * to_corner);
      const double half = std::acos(std::clamp(cosine, -1.0, 1.0));
      const double bearing = std::atan2(corner.y, corner.x);
      meet(bearing - half);
      meet(bearing + half);
    }
  }
  return least;
}

double Outline::straight_contact(Point2 point, double margin) const {
  double least = kNever;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2 a = corners_[i];
    const Point2 b = corners_[(i + 1) % corners_.size()];
    const double length = norm(b - a);
    const Point2 outwards = (-1.0 / length) * turned_left(b - a);
    const Point2 moved = a + margin * outwards;
    const Segment shifted{moved, moved + (b - a)};
    if (const auto way = ray_distance(point, {-1.0, 0.0}, shifted)) least = std::min(least, *way);
    if (const auto way = ray_distance(point, {-1.0, 0.0}, a, margin)) least = std::min(least, *way);
  }
  return least;
}

}  // namespace docent::collision_avoidance
