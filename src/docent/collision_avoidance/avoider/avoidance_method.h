#pragma once

#include <optional>
#include <span>
#include <variant>

#include "docent/collision_avoidance/avoider/bearing_choice.h"
#include "docent/collision_avoidance/avoider/speed_cap.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/collision_avoidance/body/speed_near_people.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/collision_avoidance/obstacle_field/unmapped_places.h"

namespace docent::collision_avoidance {

/// A point that a sensor met, as it lies round the robot.
struct SensedPoint {
  const ObstaclePoint& known;
  Point2 at;                                 ///< [m] base frame
  Point2 velocity{};                         ///< [m/s] likewise
  double away = 0.0;                         ///< [m] from the robot's centre
  double steps_in = 0.0;                     ///< [m] who stands farther away cannot step into its way in time
  const UnmappedPlaces* unmapped = nullptr;  ///< null where they tell nothing of now
};

/// The plain dynamic window, for comparison: steers straight for its point, and takes people for things that stand
/// where they are now.
class PlainWindow {
 public:
  explicit PlainWindow(const DynamicWindowParams& window) : margin_{window.real_margin} {}

  [[nodiscard]] Obstacle obstacle_of(const SensedPoint& point) const;
  /// What to steer for; may lower the cap.
  [[nodiscard]] Steering steer(Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                               SpeedCap& cap) const;
  /// The command, slowed for whoever may come nearer within a second; nullopt when it may stay.
  [[nodiscard]] std::optional<Velocity> slowed_for_people(const Velocity& command,
                                                          std::span<const Obstacle> obstacles) const;
  /// Whether it drives away from who goes on touching it.
  [[nodiscard]] bool leaves_who_touches() const { return false; }
  void forget() const {}  ///< nothing: it keeps nothing in mind

 private:
  double margin_;
};

struct CautionParams {
  double slowing_step = 0.05;  ///< [m/s] by which a command is slowed until it is forgivable
  double too_bold = 1.5;       ///< slowing steps by which a choice may be too fast by noise alone
  double sharpest = 3.0;       ///< [1/m] a tighter curve is nearly a turn on the spot
  double beside = -0.2;        ///< cosine of the bearing; what lies farther back slows nobody
};

/// The dynamic window, slower near things and people, who are foreseen for a second, with a way round what stands
/// before it.
class CautiousWindow {
 public:
  CautiousWindow(const BaseLimits& limits, const DynamicWindowParams& window, const PeopleCautionParams& people,
                 const BearingChoiceParams& bearing = {}, const CautionParams& params = {})
      : limits_{limits}, window_{window}, people_{people}, bearing_{limits.radius, bearing}, params_{params} {}

  [[nodiscard]] Obstacle obstacle_of(const SensedPoint& point) const;
  [[nodiscard]] Steering steer(Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                               SpeedCap& cap);
  [[nodiscard]] std::optional<Velocity> slowed_for_people(const Velocity& command,
                                                          std::span<const Obstacle> obstacles) const;
  [[nodiscard]] bool leaves_who_touches() const { return true; }
  void forget() { bearing_.forget(); }

 private:
  void cap_by_surroundings(std::span<const Obstacle> obstacles, SpeedCap& cap) const;

  BaseLimits limits_;
  DynamicWindowParams window_;
  PeopleCautionParams people_;
  BearingChoice bearing_;
  CautionParams params_;
};

using AvoidanceMethod = std::variant<CautiousWindow, PlainWindow>;

}  // namespace docent::collision_avoidance
