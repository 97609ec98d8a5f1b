#pragma once

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

}  // namespace docent::collision_avoidance
