#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/motion_models/odometry_history.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::mapping {

/// Tells whether a scanner sees the room turn the way it must. When the robot turns to the left, all that a scanner
/// sees goes to its right by the same angle; of one that hangs upside down and of which nobody says so, left and right
/// are mirrored, and it goes to the left. Sweeps some 20 to 60 degrees apart are laid onto one another by the turn of
/// the odometry and by the opposite one. It needs no map, and only turns: a mirrored scanner looks right while the
/// robot drives straight on, and lays no sweep onto another while it turns. A round room tells nothing.
class TurningSide {
 public:
  enum class Side {
    unknown,   ///< it has not turned enough, or nothing is to be seen
    right,     ///< as odometry says
    mirrored,  ///< the other way: the scanner is upside down, or odometry turns the wrong way
  };

  /// A sweep waits until odometry tells where the robot was. Ranges [m] in the sensor's frame. O(beams)
  void keep(Time stamp, const sensor_models::LaserReading& reading);
  /// Looks at the sweeps that waited. O(sweeps * directions)
  void follow(const motion_models::OdometryHistory& odometry);
  /// Nothing holds over a jump of the odometry.
  void forget();
  [[nodiscard]] Side side() const { return side_; }

 private:
  struct Look {
    Time stamp{};
    std::vector<float> ranges;  ///< [directions of a turn] [m], NaN: nobody looked there, infinity: nothing came back
    Pose2 odom_from_base{};
  };
  /// What two looks say: the shares of the directions that agree after the turn, and after the opposite one.
  struct Pair {
    double as_said = 0.0;
    double mirrored = 0.0;
    double turn = 0.0;  ///< [rad], > 0
  };
  [[nodiscard]] static std::optional<Pair> compared(const Look& before, const Look& now);
  void judge();

  std::deque<Look> waiting_;
  std::optional<Look> reference_;
  std::deque<Pair> pairs_;  ///< the last ones
  Side side_ = Side::unknown;
};

}  // namespace docent::mapping
