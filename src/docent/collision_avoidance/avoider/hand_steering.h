#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/collision_avoidance/body/base_motion.h"

namespace docent::collision_avoidance {

/// What an operator's hand wants, shares of what the robot may do.
struct HandSteering {
  bool is_pressed = false;  ///< the dead man's switch
  double forward = 0.0;     ///< -1..1
  double turn = 0.0;        ///< -1..1, to the left
};

/// When an operator steers.
struct HandParams {
  double watchdog = 0.5;   ///< [s] without word from their hand, then the robot stands
  double returns = 3.0;    ///< [s] after it, then it goes its own way again
  double full_turn = 1.0;  ///< [rad] of bearing for which a stick that is turned fully stands, in driving
  double distance = 2.0;   ///< [m] to the point that is steered for
  double backwards = 0.5;  ///< share of the top speed, for nobody looks there
  double least = 0.05;     ///< a smaller share of either is none
};

/// When a robot that docks says which velocity it wants.
struct DockDriveParams {
  double watchdog = 0.3;  ///< [s] without a new wish, then it no longer counts
  double slow = 0.1;      ///< [m/s] no faster, the robot may come nearer to things than in driving,
  double nearer = 0.05;   ///< [m] by so much: contacts lie within the margins
};

/// The velocity that a docking robot wants, as long as it is fresh.
class DockDrive {
 public:
  explicit DockDrive(const DockDriveParams& params = {}) : params_{params} {}
  void want(Time now, const Velocity& velocity) { wish_ = Wish{velocity, now}; }
  /// nullptr: it does not dock.
  [[nodiscard]] const Velocity* wish(Time now) const {
    return wish_ && now - wish_->said <= seconds(params_.watchdog) ? &wish_->velocity : nullptr;
  }
  /// [m] by which a robot with this command may come nearer to things.
  [[nodiscard]] double nearer(Time now, const Velocity& command) const {
    return wish(now) != nullptr && command.linear <= params_.slow && command.linear >= -params_.slow ? params_.nearer
                                                                                                     : 0.0;
  }

 private:
  struct Wish {
    Velocity velocity;
    Time said;
  };
  DockDriveParams params_;
  std::optional<Wish> wish_;
};

}  // namespace docent::collision_avoidance
