#pragma once

#include <optional>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::planning {

struct DockApproachParams {
  double contact = 0.35;       ///< [m] > 0 from the tag to the base at the contacts
  double straight = 0.6;       ///< [m] > 0 before the contacts that are driven straight
  double speed = 0.25;         ///< [m/s] > 0 towards where the straight way begins
  double last_speed = 0.08;    ///< [m/s] > 0 on the straight way, and
  double press_speed = 0.04;   ///< [m/s] > 0 from where it is judged
  double turn = 0.5;           ///< [rad/s] > 0 at most
  double towards = 0.5;        ///< [1/s] > 0 speed by distance
  double bearing = 1.5;        ///< [1/s] > towards: turn by the bearing of where the straight way begins
  double heading = -0.8;       ///< [1/s] < 0: turn by the line's heading there
  double across = 50.0;        ///< [1/m²] > 0: curvature by the distance from the line on the straight way, and
  double along = 14.0;         ///< [1/m] > 0 by the angle to it
  double most_across = 0.012;  ///< [m] > 0 off the line shortly before the contacts, else it backs off
  double most_angle = 4.0;     ///< [deg] > 0, likewise
  double judged = 0.12;        ///< [m] > 0 before the contacts where that is judged
  double back_off = 0.7;       ///< [m] > 0 that it then backs along the line
  int attempts = 4;            ///< >= 1
  double look_s = 15.0;        ///< [s] > 0 for the first sight of the tag
  double press = 0.02;         ///< [m] >= 0 that it drives on past where the contacts should be, and stands there
  double wait_s = 4.0;         ///< [s] > 0 for the current, of which a battery may tell once a second
  [[nodiscard]] Result<void> validate() const;
};

/// What an approach knows.
struct DockApproachView {
  Pose2 odom_from_base;
  Pose2 odom_from_expected;            ///< where the tag should stand, by the map; x points out of it
  std::optional<Pose2> odom_from_tag;  ///< as it was seen, once that is sure
  bool is_touching = false;            ///< the contacts have current
};

/// Drives a base to the charger's contacts along a line in odometry's frame: looks for the tag, curves to where the
/// straight way begins (the law of Aicardi and others for unicycles, 1995), follows the line, and shortly before the
/// contacts backs off if it is not on it; at the contacts it stands and waits for the current. It heeds no obstacles:
/// whoever drives by it watches them. Deterministic.
class DockApproach {
 public:
  /// @pre params are valid
  DockApproach(const DockApproachParams& params, Time now) : params_{params}, since_{now} {}

  enum class State { looks, curves, goes_straight, waits, backs_off, docked, failed };
  struct Command {
    double speed = 0.0;  ///< [m/s]
    double turn = 0.0;   ///< [rad/s]
  };
  [[nodiscard]] Command step(const DockApproachView& view, Time now);
  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] int attempts() const { return attempts_; }

 private:
  [[nodiscard]] Command look(const DockApproachView& view, Time now);
  [[nodiscard]] Command curve(const Pose2& tag_from_base, Time now);
  [[nodiscard]] Command go_straight(const Pose2& tag_from_base, Time now);
  /// Once more from farther off, or not at all.
  void begin_anew();
  [[nodiscard]] Command back_off(const Pose2& tag_from_base);
  [[nodiscard]] Command limited(double speed, double turn) const;

  DockApproachParams params_;
  Time since_;  ///< of looking, or of waiting
  State state_ = State::looks;
  int attempts_ = 1;
};

}  // namespace docent::planning
