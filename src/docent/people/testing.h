#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/people/sightings.h"

namespace docent::people {

/// For tests: what 360 beams from a robot in an empty world see of discs and straight walls, with noise where there is
/// a generator. What is added as known is the map's, all else is not.
class Scene {
 public:
  explicit Scene(Rng* rng = nullptr, const Pose2& world_from_robot = {}) : rng_{rng}, pose_{world_from_robot} {}

  void add_disc(Point2 centre, double radius, bool in_map = false) { discs_.push_back({centre, radius, in_map}); }
  void add_wall(Point2 from, Point2 to, bool in_map = false) { walls_.push_back({from, to, in_map}); }

  /// @param knows  false: nobody knows what the map holds. Odometry is true.
  [[nodiscard]] PeopleSweep sweep(bool knows = true) const {
    PeopleSweep seen;
    seen.odom_from_base = pose_;
    for (int i = -180; i < 180; ++i) {
      const double bearing = (i + 0.5) * std::numbers::pi / 180.0;
      const auto [range, in_map] = cast(unit(pose_.theta + Angle::radians(bearing)));
      const bool none = range >= kMaxRange;
      const double noise = rng_ != nullptr && !none ? rng_->normal(0.0, 0.02) : 0.0;
      seen.sweep.beams.push_back({bearing, range + noise, none});
      seen.origins.push_back(none || !knows ? sensor_models::BeamOrigin::unknown
                             : in_map       ? sensor_models::BeamOrigin::map
                                            : sensor_models::BeamOrigin::not_map);
    }
    return seen;
  }
  /// Endpoints on everything, by bearing; world.
  [[nodiscard]] std::vector<Point2> ends_on_things() const {
    const PeopleSweep seen = sweep();
    std::vector<Point2> ends;
    for (const sensor_models::SweepBeam& beam : seen.sweep.beams)
      if (!beam.no_return) ends.push_back(seen.odom_from_base * sensor_models::endpoint(beam));
    return ends;
  }

 private:
  static constexpr double kMaxRange = 10.0;
  struct Disc {
    Point2 centre;
    double radius;
    bool in_map;
  };
  struct Wall {
    Point2 from, to;
    bool in_map;
  };
  [[nodiscard]] std::pair<double, bool> cast(Point2 ray) const {
    std::pair<double, bool> nearest{kMaxRange, false};
    const auto offer = [&](double range, bool in_map) {
      if (range > 0.0 && range < nearest.first) nearest = {range, in_map};
    };
    for (const Disc& disc : discs_) {
      const Point2 to = disc.centre - pose_.position();
      const double off = cross(ray, to);
      if (std::abs(off) < disc.radius)
        offer(dot(ray, to) - std::sqrt(disc.radius * disc.radius - off * off), disc.in_map);
    }
    for (const Wall& wall : walls_) {
      const Point2 along = wall.to - wall.from;
      const Point2 to = wall.from - pose_.position();
      const double turn = cross(ray, along);
      if (std::abs(turn) < 1e-9) continue;
      const double part = cross(to, ray) / turn;
      if (part >= 0.0 && part <= 1.0) offer(cross(to, along) / turn, wall.in_map);
    }
    return nearest;
  }

  Rng* rng_;
  Pose2 pose_;
  std::vector<Disc> discs_;
  std::vector<Wall> walls_;
};

}  // namespace docent::people
