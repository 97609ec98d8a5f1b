#pragma once

#include <cstddef>
#include <optional>
#include <span>
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
  double tag_stand_off_m = 1.5;  ///< [m] > 0: so far before the contacts it looks for the charger's tag (section dock)
  double tag_answer_s = 3.0;     ///< [s] > 0 until `dock` takes an order
  bool by_action = false;        ///< the base docks and undocks by itself, by the actions /dock and /undock of
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
    v("tag_stand_off_m", tag_stand_off_m);
    v("tag_answer_s", tag_answer_s);
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

/// How docking by the charger's tag goes, of the order that was given last.
enum class ByTag {
  none,     ///< there is no eye, or it is broken
  ready,    ///< nothing was ordered, or it has not been taken yet
  drives,   ///< under way
  arrived,  ///< at the contacts
  failed,
};

/// Where a docking begins.
enum class DockingStart {
  at_charger,      ///< it stands there
  occupied,        ///< before a charger on which something stands
  before_tag,      ///< so far before the contacts that the tag is seen
  at_charger_tag,  ///< it stands somewhere about the charger, and can dock by the tag
};

/// Where a docking by the tag may begin: it curves to the line by itself.
struct BeforeTag {
  static constexpr double kPosition = 0.6;  ///< [m] about the place `tag_stand_off_m` before the contacts
  static constexpr double kHeading = 0.5;   ///< [rad]
};

/// What a docking robot knows.
struct DockingView {
  Contact contact = Contact::unheard;
  std::optional<GoalStatus> moved{};  ///< how the drive named by `move` goes; nullopt: nothing is said of it
  double blocked_s = 0.0;             ///< [s] that this drive makes no progress
  bool is_occupied = false;           ///< something that is not in the map stands where the robot would stand
  ByTag by_tag = ByTag::none;
};

/// From before the charger to charging. A robot that sees the charger's tag docks by it, twice if need be; where that
/// fails, and where there is no tag: waits until the battery says that it charges. Where it does not, the robot
/// comes closer, then sets out anew from before the charger, then from behind it, and at last gives up. Where something
/// stands on the charger, it waits for that to go, tries again, beside it, and from behind. A battery that never says
/// whether it charges is believed to, once the robot stands there. Deterministic.
class Docking {
 public:
  Docking(const DockingParams& params, Pose2 map_from_charger, DockingStart start, Time now);

  enum class State { under_way, sets_out, docked, failed };

  /// A drive of an attempt; its name is used once in a docking.
  struct Move {
    std::string name;
    Pose2 map_from_base;
    double position_tolerance = 0.0;  ///< [m]
    double heading_tolerance = 0.1;   ///< [rad]
  };
  /// nullopt: the robot stands where it came to.
  [[nodiscard]] std::optional<Move> move() const;

  /// The robot docks by the tag now: a name that is used once in a docking. nullopt: it does not.
  [[nodiscard]] std::optional<std::string> tag_order() const;

  /// It docks by the tag, or stands where that has led it.
  [[nodiscard]] bool is_by_tag() const;

  /// @returns how it stands; sets_out: `move` or `tag_order` is another one now.
  State step(const DockingView& view, Time now);

  /// Something stands on the charger, as far as it has seen.
  [[nodiscard]] bool is_occupied() const { return is_occupied_; }
  /// Why it failed: charger_occupied, charger_no_current (it stood there and the battery did not charge), or
  /// not_reached.
  [[nodiscard]] ReasonWord failure() const;

 private:
  struct Step;
  [[nodiscard]] std::span<const Step> steps() const;
  [[nodiscard]] const Step* now_at() const;  ///< nullptr: all steps are over
  [[nodiscard]] bool is_over(const Step& step, const DockingView& view, Time now) const;
  void note(const Step& step, const DockingView& view);

  DockingParams params_;
  Pose2 map_from_charger_;
  Time since_;            ///< of the present step
  std::size_t step_ = 0;  ///< of those in docking.cpp
  DockingStart start_;
  bool is_occupied_;
  bool stands_there_;   ///< the last drive to the charger arrived
  bool stood_there_;    ///< one of them did
  Time last_occupied_;  ///< when something was last seen there
};

}  // namespace docent::task_control
