#pragma once

#include <optional>
#include <span>

#include "docent/collision_avoidance/base_motion.h"
#include "docent/collision_avoidance/crowd_field.h"

namespace docent {

/// Where to head and how fast at most.
struct CrowdAdvice {
  double bearing = 0.0;  ///< [rad], base frame
  double speed = 0.0;    ///< [m/s]; 0: wait, turned to where the way will open
  bool waits = false;
};

/// Crowd-fit driving: chooses a heading and a speed through the gaps between people in place and time. Candidates are
/// rolled out with the base's own turning and acceleration through the CrowdField and end in its time to go. It only
/// proposes: the dynamic window brakes before contact as without it.
class CrowdSteering {
 public:
  CrowdSteering(const BaseLimits& limits, const CrowdFitParams& params);

  /// @param start  the base when what is chosen takes effect
  /// @param obstacles  [m] in the frame of that base
  /// @param cycle  [s] since the last choice
  /// O(field + headings * speeds * steps).
  [[nodiscard]] CrowdAdvice steer(const BaseState& start, std::span<const Obstacle> obstacles, const CrowdPath& path,
                                  double speed_cap, double cycle);
  void forget() { last_in_odom_.reset(); }

 private:
  [[nodiscard]] double cost_of(const BaseState& start, double bearing, double speed) const;

  BaseLimits limits_;
  CrowdFitParams params_;
  CrowdField field_;
  std::vector<Obstacle> in_odom_;
  std::optional<Angle> last_in_odom_;
  double stood_ = 0.0;  ///< [s] lately
};

}  // namespace docent
