#pragma once

#include <array>
#include <optional>
#include <span>

#include "docent/collision_avoidance/base_motion.h"
#include "docent/collision_avoidance/crowd_field.h"

namespace docent {

/// Where to head and how fast at most.
struct CrowdAdvice {
  double bearing = 0.0;  ///< [rad], base frame; of the back when `tail_first`
  double speed = 0.0;    ///< [m/s]; 0: wait, turned to where the way will open
  bool waits = false;
  bool tail_first = false;  ///< a disc with eyes all round drives either way
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
  [[nodiscard]] const CrowdField& field() const { return field_; }
  void forget() {
    last_in_odom_.reset();
    field_.forget();
  }

 private:
  /// A place where something stood when it was last in sight.
  struct Stand {
    Point2 at;            ///< [m], odom
    double stood = 0.0;   ///< [s]
    double hidden = 0.0;  ///< [s] behind somebody else
  };
  using Stands = std::array<Stand, 4096>;  ///< 64 x 64 cells of 15 cm, repeated every 9.6 m
  void place(const Pose2& odom_from_base, std::span<const Obstacle> obstacles);
  void remember(Point2 robot, double cycle);
  [[nodiscard]] static std::size_t index_of(Point2 in_odom);
  [[nodiscard]] double cost_of(const BaseState& start, double bearing, double speed) const;

  BaseLimits limits_;
  CrowdFitParams params_;
  CrowdField field_;
  std::vector<Obstacle> in_odom_;
  Stands stands_{};
  std::optional<Angle> last_in_odom_;
  double stood_ = 0.0;  ///< [s] lately
};

}  // namespace docent
