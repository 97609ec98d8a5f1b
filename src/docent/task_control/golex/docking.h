#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// Section `executive.docking` of robot.yaml.
struct DockingParams {
  double contact_s = 10.0;         ///< [s] > 0 at the charger until the battery says that it charges
  double move_s = 30.0;            ///< [s] > 0 for one drive of an attempt
  double stand_off_m = 0.6;        ///< [m] > 0: so far from the charger it sets out anew
  double closer_tolerance = 0.08;  ///< [m] > 0 of an attempt: the first arrival may have been too far off
  template <class V>
  void visit(V& v) {
    v("contact_s", contact_s);
    v("move_s", move_s);
    v("stand_off_m", stand_off_m);
    v("closer_tolerance", closer_tolerance);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(contact_s > 0.0)) return fail("docking.contact_s must be > 0");
    if (!(move_s > 0.0)) return fail("docking.move_s must be > 0");
    if (!(stand_off_m > 0.0)) return fail("docking.stand_off_m must be > 0");
    if (!(closer_tolerance > 0.0)) return fail("docking.closer_tolerance must be > 0");
    return {};
  }
};

/// What the battery at the charger says.
enum class Contact {
  unheard,  ///< nothing yet
  unknown,  ///< it never says whether it charges
  none,
  made,
};

/// From standing at the charger to charging: waits until the battery says that it charges. Where it does not, the robot
/// comes closer, then sets out anew from before the charger, then from behind it, and at last gives up. A battery that
/// never says whether it charges is believed to. Deterministic.
class Docking {
 public:
  Docking(const DockingParams& params, Pose2 map_from_charger, Time now)
      : params_{params}, map_from_charger_{map_from_charger}, since_{now} {}

  enum class State { under_way, sets_out, docked, failed };

  /// A drive of an attempt; its name is used once in a docking.
  struct Move {
    std::string name;
    Pose2 map_from_base;
    double position_tolerance = 0.0;  ///< [m]
  };
  /// nullopt: the robot stands where it came to.
  [[nodiscard]] std::optional<Move> move() const;

  /// @param moved  what became of the drive named by `move`.
  /// @returns how it stands; sets_out: `move` is another one now.
  State step(Contact contact, std::optional<GoalStatus> moved, Time now);

 private:
  DockingParams params_;
  Pose2 map_from_charger_;
  Time since_;            ///< of the present step
  std::size_t step_ = 0;  ///< of those in docking.cpp
};

}  // namespace docent::task_control
