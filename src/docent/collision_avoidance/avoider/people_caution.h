#pragma once

#include <optional>
#include <span>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/obstacle.h"
#include "docent/collision_avoidance/body/speed_near_people.h"
#include "docent/collision_avoidance/body/unseen_bodies.h"
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

struct CautionParams {
  double slowing_step = 0.05;  ///< [m/s] by which a command is slowed until it is forgivable
  double too_bold = 1.5;       ///< slowing steps by which a choice may be too fast by noise alone
  double sharpest = 3.0;       ///< [1/m] a tighter curve is nearly a turn on the spot
};

/// What holds near people, whoever chose the velocity: which points may be somebody, who is foreseen for a second, and
/// how fast the robot may drive past them.
class PeopleCaution {
 public:
  /// @param margin  [m] kept to what was sensed
  /// @param foresees_people  false: takes people for things that stand where they are now, for comparison
  /// @param bodies  how much farther than that people reach
  PeopleCaution(const BaseLimits& limits, double margin, const PeopleCautionParams& people, const UnseenBodies& bodies,
                bool foresees_people, const CautionParams& params = {})
      : limits_{limits},
        margin_{margin},
        people_{people},
        bodies_{bodies},
        foresees_people_{foresees_people},
        params_{params} {}

  /// Legs, which is all that a low laser sees of somebody, get the margin of the body above them.
  [[nodiscard]] Obstacle obstacle_of(const SensedPoint& point) const;
  /// The command, slowed for whoever may come nearer within a second; nullopt when it may stay.
  [[nodiscard]] std::optional<Velocity> slowed_for_people(const Velocity& command,
                                                          std::span<const Obstacle> obstacles) const;
  /// Whether the robot drives away from who goes on touching it.
  [[nodiscard]] bool leaves_who_touches() const { return foresees_people_; }

 private:
  BaseLimits limits_;
  double margin_;
  PeopleCautionParams people_;
  UnseenBodies bodies_;
  bool foresees_people_;
  CautionParams params_;
};

}  // namespace docent::collision_avoidance
