#pragma once

#include <deque>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::simulator {

/// The true body: a B21-like disc on two driven wheels. The robot's own configuration says nearly the same; the errors
/// below are what it does not know.
struct BodyParams {
  double radius = 0.265;           ///< [m]
  double wheel_base = 0.42;        ///< [m]
  double max_speed = 1.7;          ///< [m/s] what the motors can
  double max_turn_rate = 1.5;      ///< [rad/s]
  double acceleration = 0.5;       ///< [m/s^2]
  double deceleration = 1.0;       ///< [m/s^2]
  double turn_acceleration = 1.5;  ///< [rad/s^2]
  double latency = 0.15;           ///< [s] from a command to the wheels; the true one is drawn within latency_spread
  double latency_spread = 0.2;     ///< share
  double watchdog = 0.3;           ///< [s] without a command, then the base brakes by itself
  double scale_error = 0.007;      ///< largest error of both wheels' odometry together
  double wheel_error = 0.003;      ///< largest error of one wheel more
  double base_error = 0.01;        ///< largest error of the wheel base that the odometry believes
  double travel_noise = 0.01;      ///< [m / sqrt(m)] of each wheel's odometry
  double turn_noise = 0.01;        ///< [rad / sqrt(rad)]
  double slip = 0.02;              ///< share of the motion lost at full acceleration or braking
};

/// Drive of the robot: latency, limits, watchdog, slip, and the odometry that comes of it.
class Body {
 public:
  Body(const BodyParams& params, const Pose2& start, const Rng& rng);

  /// A velocity command arrives. What is not finite counts as zero.
  void command(Time now, double linear, double angular);
  /// One step of the wheels and of the pose, as if nothing were in the way. @param dt [s]
  void step(Time now, double dt, bool has_power);
  /// The world pushes back: the true position is another. The wheels, and so the odometry, do not notice.
  void correct(Point2 position) { pose_ = {position.x, position.y, pose_.theta}; }
  /// Someone carries the robot: the wheels do not turn.
  void carry_to(const Pose2& pose) { pose_ = pose; }
  /// Likewise, and puts it on the floor: whoever holds it takes its speed away, but `keeps` of it, 0..1. The wheels go
  /// on to do what they were told last.
  void set_down(const Pose2& pose, double keeps) {
    pose_ = pose;
    linear_ *= keeps;
    angular_ *= keeps;
  }

  [[nodiscard]] const Pose2& pose() const { return pose_; }      ///< world_from_base
  [[nodiscard]] const Pose2& odometry() const { return odom_; }  ///< odom_from_base
  [[nodiscard]] double linear() const { return linear_; }        ///< [m/s] of the wheels
  [[nodiscard]] double angular() const { return angular_; }      ///< [rad/s] of the wheels
  /// It decelerates as hard as it can, or stands.
  [[nodiscard]] bool is_braking_fully() const { return is_braking_; }
  [[nodiscard]] const BodyParams& params() const { return params_; }
  [[nodiscard]] double latency() const { return latency_; }
  /// Way to a stop when full braking begins after `reaction` [s].
  [[nodiscard]] double stopping_distance(double reaction) const;

 private:
  struct Command {
    Time due;
    double linear;
    double angular;
  };

  BodyParams params_;
  Rng rng_;
  double latency_ = 0.15;
  double left_scale_ = 1.0;
  double right_scale_ = 1.0;
  double base_scale_ = 1.0;
  Pose2 pose_;
  Pose2 odom_{};
  double linear_ = 0.0;
  double angular_ = 0.0;
  bool is_braking_ = true;
  std::deque<Command> commands_;  ///< under way to the wheels
  double wanted_linear_ = 0.0;
  double wanted_angular_ = 0.0;
  Time last_command_{-1000000000000};
};

}  // namespace docent::simulator
