#pragma once

#include <optional>
#include <string>

#include "docent/base/time.h"
#include "docent/task_control/tour_scheduler/task_order.h"
#include "docent/vocabulary/reason.h"

namespace docent::task_control {

class Mission;

/// What the robot is doing.
enum class Activity {
  none,
  visit,
  farewell,
  home,
  charge,
  relocalize,
  mingle,
  action,  ///< one that the planner ordered by its name
};

/// What a planner sees when it decides.
struct Situation {
  Activity activity = Activity::none;
  bool may_interrupt = true;  ///< nothing is being explained or asked
  bool is_localized = false;
  bool is_lost = false;             ///< not localized for `lost_after_s`
  bool is_settled = false;          ///< localized for `localized_after_s`
  bool was_ever_localized = false;  ///< since it woke up
  bool has_visit = false;           ///< one is under way or suspended
  bool has_tour = false;            ///< likewise
  bool has_farewell = false;        ///< a tour has ended: its visitors wait for a last word
  bool is_anything_due = false;     ///< somebody waits whose turn it may be
  bool is_open = true;              ///< requests are taken
  bool is_blocked = false;          ///< people stand in its way
  std::optional<double> charge{};   ///< 0..1; nullopt: the battery never spoke
  bool is_charging = false;
  bool is_charged = true;  ///< well enough for what is wanted
  bool has_charger = false;
  bool is_low_soon = false;  ///< between two tours is the time to charge
  bool must_charge = false;  ///< before it goes on
  bool charges = false;      ///< it must, or does as long as nobody wants anything
  bool may_serve = true;     ///< its charge is enough for the next visit
  bool may_mingle = false;   ///< it rests at home in an open museum, and people are near whom it may attract
};

/// How an action went.
struct ActionOutcome {
  bool is_done = false;    ///< else it failed
  bool took_long = false;  ///< the visitor asked for more
  Reason reason{};
};

/// Chooses what the robot does next, from the primitive actions that the mission offers. One of two stands above the
/// executive: the plan-based controller ([Minerva2000] 5.3) or a museum's GOLOG program ([Rhino1999] 4.3).
class Planner {
 public:
  Planner() = default;
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;
  virtual ~Planner() = default;

  /// Called when anything has happened, and twice a second: orders at most one new action of the mission.
  virtual void decide(Mission& mission, Time now) = 0;
  /// An action that it ordered by `Mission::order_action` is over.
  virtual void outcome(Mission& /*mission*/, const TaskOrder& /*order*/, const ActionOutcome& /*outcome*/,
                       Time /*now*/) {}
  /// Whether it can drive to a point on the map for which a Web visitor wishes.
  [[nodiscard]] virtual bool serves_points() const { return true; }
  /// What must survive a restart; empty: nothing.
  [[nodiscard]] virtual std::string memory() const { return {}; }
  /// Goes on from there. True: it orders actions by their names, of which `task` may be one that is under way.
  [[nodiscard]] virtual bool restore(const std::string& /*memory*/, TaskOrder& /*task*/) { return false; }
  /// Why it does not work as it should; empty: it does.
  [[nodiscard]] virtual std::string fault() const { return {}; }
};

}  // namespace docent::task_control
