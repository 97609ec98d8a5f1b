#pragma once

#include <span>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"
#include "docent/collision_avoidance/local_planner/bearing_choice.h"
#include "docent/collision_avoidance/local_planner/local_planner.h"

namespace docent::collision_avoidance {

/// Sharp turns are driven slowly, and on the spot where the way lies behind.
struct SharpTurnParams {
  double full_turn_cap = 1.35;  ///< share of the speed that a way straight ahead would allow, were 1 not enough
  double turn_scale = 1.1;  ///< [rad] of bearing that cost a share of 1: from 1.5 rad on the robot turns on the spot
};

/// The plain dynamic window, for comparison: steers straight for its point.
class PlainWindow final : public LocalPlanner {
 public:
  PlainWindow(const BaseLimits& limits, const DynamicWindowParams& window, const SharpTurnParams& turns = {})
      : window_{limits, window}, turns_{turns} {}

  [[nodiscard]] LocalPlan plan(const LocalTask& task) override;
  void forget() override {}  ///< nothing: it keeps nothing in mind

 private:
  DynamicWindow window_;
  SharpTurnParams turns_;
};

/// The dynamic window, slower near things, with a way round what stands before it.
class CautiousWindow final : public LocalPlanner {
 public:
  CautiousWindow(const BaseLimits& limits, const DynamicWindowParams& window, const SharpTurnParams& turns = {},
                 const BearingChoiceParams& bearing = {})
      : limits_{limits}, params_{window}, window_{limits, window}, turns_{turns}, bearing_{limits.radius, bearing} {}

  [[nodiscard]] LocalPlan plan(const LocalTask& task) override;
  void forget() override { bearing_.forget(); }

 private:
  void cap_by_surroundings(std::span<const Obstacle> obstacles, SpeedCap& cap) const;

  BaseLimits limits_;
  DynamicWindowParams params_;
  DynamicWindow window_;
  SharpTurnParams turns_;
  BearingChoice bearing_;
};

}  // namespace docent::collision_avoidance
