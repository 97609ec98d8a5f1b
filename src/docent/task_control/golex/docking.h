#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// Section `executive.docking` of robot.yaml.
struct DockingParams {
  double contact_s = 10.0;         ///< [s] > 0 at the charger until the battery says that it charges
  double move_s = 30.0;            ///< [s] > 0 for one drive of an attempt
  double stand_off_m = 0.6;        ///< [m] > 0: so far from the charger it sets out anew
  double closer_tolerance = 0.08;  ///< [m] > 0 of an attempt: the first arrival may have been too far off
  double occupied_near_m = 1.5;    ///< [m] > 0 straight from the charger: what holds it up there is on the charger
  double occupied_after_s = 4.0;   ///< [s] > 0 before a charger on which something stands, until that is believed
  double occupied_wait_s = 20.0;   ///< [s] > 0 that it then waits: who stands there may go
  double blocked_s = 8.0;          ///< [s] > 0 without progress that end a drive of an attempt
  double beside_tolerance = 0.28;  ///< [m] > 0: contacts may reach so far beside what stands there
  bool by_action = false;          ///< the base docks and undocks by itself, by the actions /dock and /undock of
                           ///< irobot_create_msgs. Then the museum's charger is the place before the dock, about
                           ///< 0.5 m from standing in it and looking at it
  template <class V>
  void visit(V& v) {
    v("contact_s", contact_s);
    v("move_s", move_s);
    v("stand_off_m", stand_off_m);
    v("closer_tolerance", closer_tolerance);
    v("occupied_near_m", occupied_near_m);
    v("occupied_after_s", occupied_after_s);
    v("occupied_wait_s", occupied_wait_s);
    v("blocked_s", blocked_s);
    v("beside_tolerance", beside_tolerance);
    v("by_action", by_action);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What the battery at the charger says.
enum class Contact {
  unheard,  ///< nothing yet
  unknown,  ///< it never says whether it charges
  none,
  coming,  ///< the base is docking by itself
  made,
};

/// What a docking robot knows.
struct DockingView {
  Contact contact = Contact::unheard;
  std::optional<GoalStatus> moved{};  ///< how the drive named by `move` goes; nullopt: nothing is said of it
  double blocked_s = 0.0;             ///< [s] that this drive makes no progress
  bool is_occupied = false;           ///< something that is not in the map stands where the robot would stand
};

/// From before the charger to charging: waits until the battery says that it charges. Where it does not, the robot
/// comes closer, then sets out anew from before the charger, then from behind it, and at last gives up. Where something
/// stands on the charger, it waits for that to go, tries again, beside it, and from behind. A battery that never says
/// whether it charges is believed to, once the robot stands there. Deterministic.
class Docking {
 public:
  /// @param is_occupied  the robot stands before a charger on which something stands, else at it
  Docking(const DockingParams& params, Pose2 map_from_charger, bool is_occupied, Time now);

  enum class State { under_way, sets_out, docked, failed };

  /// A drive of an attempt; its name is used once in a docking.
  struct Move {
    std::string name;
    Pose2 map_from_base;
    double position_tolerance = 0.0;  ///< [m]
  };
  /// nullopt: the robot stands where it came to.
  [[nodiscard]] std::optional<Move> move() const;

  /// @returns how it stands; sets_out: `move` is another one now.
  State step(const DockingView& view, Time now);

  /// Something stands on the charger, as far as it has seen.
  [[nodiscard]] bool is_occupied() const { return is_occupied_; }
  /// Why it failed: charger_occupied, charger_no_current (it stood there and the battery did not charge), or
  /// not_reached.
  [[nodiscard]] ReasonWord failure() const;

 private:
  struct Step;
  [[nodiscard]] const Step* now_at() const;  ///< nullptr: all steps are over
  [[nodiscard]] bool is_over(const Step& step, const DockingView& view, Time now) const;
  void note(const Step& step, const DockingView& view);

  DockingParams params_;
  Pose2 map_from_charger_;
  Time since_;            ///< of the present step
  std::size_t step_ = 0;  ///< of those in docking.cpp
  bool began_before_;     ///< a charger on which something stands
  bool is_occupied_;
  bool stands_there_;   ///< the last drive to the charger arrived
  bool stood_there_;    ///< one of them did
  Time last_occupied_;  ///< when something was last seen there
};

}  // namespace docent::task_control
