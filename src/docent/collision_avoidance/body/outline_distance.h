#pragma once

#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance {

/// The body's outline where it is no disc: a convex polygon round the robot's centre, counter-clockwise, robot frame
/// [m].
///
/// Seen from the robot, a point of the world moves against the robot's way: on a circle about the centre of the turn,
/// or straight. A contact is where that path first comes within `margin` of the polygon: where it crosses a side moved
/// outwards by the margin, or the margin's circle about a corner.
class Outline {
 public:
  Outline() = default;  ///< none
  /// Error: fewer than three corners, not convex, or the centre is not inside.
  [[nodiscard]] static Result<Outline> make(Polygon corners);

  /// The outline as robot.yaml writes it in `body.outline`, a list of [x, y] [m]; none for an empty list. Error: as
  /// make.
  [[nodiscard]] static Result<Outline> of_body(std::span<const std::vector<double>> corners);

  [[nodiscard]] bool empty() const { return corners_.empty(); }
  [[nodiscard]] const Polygon& corners() const { return corners_; }
  /// Distance [m] from the centre to the farthest corner.
  [[nodiscard]] double circumradius() const { return circumradius_; }
  /// Distance [m] from the centre to the outline along `bearing`. O(corners).
  [[nodiscard]] double radius_at(Angle bearing) const;
  /// The point of the outline that is nearest. O(corners).
  [[nodiscard]] Point2 nearest(Point2 in_base) const;
  /// Distance [m] from a point to the outline as a filled shape; 0 inside. O(corners).
  [[nodiscard]] double distance_to(Point2 in_base) const { return distance(corners_, in_base); }

  /// Length of the way [m] along the circle of the given curvature, heading +x, until the outline is `margin` away from
  /// the point. Closed form, O(corners). A point within the margin already gives 0 when the first step brings them
  /// nearer, else infinity; infinity also when they never meet.
  /// @param curvature  [1/m], positive to the left, of the centre's path
  [[nodiscard]] double arc_distance(double curvature, Point2 point, double margin) const;
  /// Speed [m/s] at which the body, driving and turning so, comes nearer to a point that stands; negative: goes away.
  [[nodiscard]] double closing_speed(double linear, double angular, Point2 point) const;

 private:
  /// Angle [rad] in (0, 2 pi) that the point turns about `pivot`, in the direction of `side`, until it is within
  /// `margin`.
  [[nodiscard]] double first_contact(Point2 pivot, double side, Point2 point, double margin) const;
  [[nodiscard]] double straight_contact(Point2 point, double margin) const;
  /// Unit vector along which the point leaves the body soonest.
  [[nodiscard]] Point2 outwards(Point2 point) const;

  Polygon corners_;
  double circumradius_ = 0.0;
};

}  // namespace docent::collision_avoidance
