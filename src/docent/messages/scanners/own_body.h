#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"

namespace docent {

/// Takes out what beams read that graze a thing close by: where half of a beam ends on it and half behind, the reading
/// lies anywhere between, and is of nothing. Such readings stand alone: they are nearer than what the first clear beams
/// on both sides read. A person or a wall there is seen by these, too. Live they stay: an obstacle more is on the safe
/// side, a wider gap in which nothing is seen is not.
/// @param grazes  [beams] those on the thing's rim and on it, if they did not end there
void take_out_grazing(std::span<float> ranges, const std::vector<bool>& grazes);

/// What a scanner sees of the robot that carries it: posts, a mast, cables. It never moves with respect to the scanner
/// and lies inside the body, so it is learned from the first sweeps and taken out of all that follow. Something else at
/// the same place cannot be seen there; what is nearer or farther along the same beam is.
class OwnBody {
 public:
  /// @param radius  [m] of the body about its centre; 0: nothing is taken out
  /// @param outline  [m] convex, of a body that is no disc; empty: it is one
  OwnBody(const Pose2& base_from_sensor, double radius, Polygon outline)
      : base_from_sensor_{base_from_sensor}, radius_{radius}, outline_{std::move(outline)} {}

  /// Learns from a sweep, and makes its readings of the body NaN. Ranges [m] and bearings [rad] in the sensor's frame
  /// (not upside down). O(beams + beams on the body * points learned nearby)
  void take_out(std::span<float> ranges, double first_bearing, double bearing_step, double min_range);

  /// [beams] those of the newest sweep that ended on the body; empty: none did.
  [[nodiscard]] const std::vector<bool>& taken_out() const { return taken_out_; }
  /// Where it sees the robot, [deg] in the robot's frame from the front: "-12..-8, 172..176"; empty: nowhere.
  [[nodiscard]] std::string where() const;
  /// It sees so much inside the body that this is no part of the robot: it is covered, or body.radius is wrong.
  [[nodiscard]] bool is_too_much() const { return is_too_much_; }

 private:
  /// What lies in one direction: while it learns, the sum of its readings' ends.
  struct Part {
    Point2 in_sensor;  ///< [m]
    float least = 0.0F, most = 0.0F;
    std::size_t beams = 0;   ///< that looked there
    std::size_t met = 0;     ///< of them, that ended inside the body
    std::size_t missed = 0;  ///< sweeps on end
  };
  [[nodiscard]] bool is_inside(double range, Angle bearing, double more) const;
  void learn(std::span<const float> ranges, double first_bearing, double bearing_step, double min_range);
  void conclude();

  Pose2 base_from_sensor_;
  double radius_;
  Polygon outline_;
  std::size_t sweeps_ = 0;
  std::vector<Part> directions_;  ///< while it learns
  std::vector<Part> parts_;       ///< of the robot, by rising bearing
  std::vector<bool> taken_out_;
  bool is_too_much_ = false;
};

}  // namespace docent
