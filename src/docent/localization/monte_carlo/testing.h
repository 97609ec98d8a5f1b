#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/localization/markov/testing.h"
#include "docent/localization/particles/testing.h"

/// Drives for the tests of this folder.
namespace docent::localization::testing {

/// A robot that drives round the drawn room, with odometry that drifts and people about it.
class Drive {
 public:
  Drive(const sensor_models::RayCaster& caster, std::uint64_t seed, double blocked)
      : caster_{caster}, rng_{Rng{seed}.stream("drive")}, blocked_{blocked} {
    next_ = static_cast<std::size_t>(rng_.integer(0, static_cast<std::int64_t>(way().size()) - 1));
    truth_ = {way()[next_].x, way()[next_].y, Angle::degrees(rng_.uniform(-180.0, 180.0))};
  }

  /// A tenth of a metre on, or 10 degrees of a turn on the spot.
  void advance() {
    Point2 target = way()[next_];
    if (distance(truth_.position(), target) < 0.1) {
      next_ = (next_ + 1) % way().size();
      target = way()[next_];
    }
    const double off = (direction(truth_.position(), target) - truth_.theta).degrees();
    Pose2 step{0.1, 0.0, Angle::degrees(std::clamp(off, -10.0, 10.0))};
    if (std::abs(off) > 10.0) step.x = 0.0;
    truth_ = truth_ * step;
    const Pose2 error{rng_.normal(0.0, 0.005), rng_.normal(0.0, 0.003), Angle::degrees(rng_.normal(0.0, 0.4))};
    odom_ = odom_ * (step * error);
    time_ = time_ + seconds(0.2);
    if (++steps_ % 5 == 1) {
      for (double& of : people_) of = rng_.chance(blocked_) ? rng_.uniform(0.4, 1.5) : 100.0;
    }
  }
  /// Somebody carries the robot to the far side of its way, and turns it.
  void kidnap() {
    next_ = (next_ + way().size() / 2) % way().size();
    truth_ = {way()[next_].x, way()[next_].y, truth_.theta + Angle::degrees(120.0)};
  }

  [[nodiscard]] sensor_models::RangeSweep sweep() {
    sensor_models::RangeSweep sweep = sweep_at(caster_, truth_, 10.0);
    for (sensor_models::SweepBeam& beam : sweep.beams) {
      if (!beam.no_return) beam.range = std::max(0.05, beam.range + rng_.normal(0.0, 0.02));
      const auto sector =
          static_cast<std::size_t>((beam.bearing + std::numbers::pi) / (2.0 * std::numbers::pi) * 17.99);
      if (people_[sector] < beam.range) beam = {beam.bearing, people_[sector], false};
    }
    return sweep;
  }
  [[nodiscard]] const Pose2& truth() const { return truth_; }
  [[nodiscard]] const Pose2& odom() const { return odom_; }
  [[nodiscard]] Time time() const { return time_; }

 private:
  static const std::vector<Point2>& way() {
    static const std::vector<Point2> points{{0.8, 0.8}, {2.4, 0.8}, {2.4, 2.2}, {3.6, 2.2}, {3.6, 1.0}, {4.4, 1.4},
                                            {5.3, 1.6}, {5.2, 2.7}, {3.7, 2.6}, {2.4, 2.5}, {0.6, 2.3}};
    return points;
  }
  const sensor_models::RayCaster& caster_;
  Rng rng_;
  double blocked_;
  std::array<double, 18> people_{};
  std::size_t next_ = 0;
  std::size_t steps_ = 0;
  Pose2 truth_;
  Pose2 odom_{1.0, -2.0, Angle::degrees(30.0)};
  Time time_ = time_from_seconds(100.0);
};

inline bool is_right(const std::optional<Pose2>& found, const Pose2& truth) {
  return found && distance(found->position(), truth.position()) < 0.5 &&
         std::abs((found->theta - truth.theta).degrees()) < 20.0;
}

}  // namespace docent::localization::testing
