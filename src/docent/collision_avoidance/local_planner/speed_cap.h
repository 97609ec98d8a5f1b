#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace docent::collision_avoidance {

/// The speed [m/s] that the robot may drive at most, and why it is no more.
struct SpeedCap {
  double speed = 0.0;
  std::string reason;

  void lower(double cap, std::string_view why) {
    if (cap >= speed) return;
    speed = std::max(0.0, cap);
    reason = why;
  }
};

}  // namespace docent::collision_avoidance
