#include "docent/task_control/plan_controller/plan_controller.h"

#include <array>

#include "docent/task_control/mission/mission.h"

namespace docent::task_control {
namespace {

enum class Round { goes_on, is_over };

/// One routine: does it apply, and what does it do?
struct Routine {
  bool (*applies)(const Situation& seen);
  Round (*act)(Mission& mission, const Situation& seen, Time now);
};

Round rest(Mission& mission, const Situation& seen, Time now) {
  if (seen.charges && seen.has_charger) {
    mission.go_charging(now);
  } else {
    mission.go_home(now);
  }
  return Round::is_over;
}

Round look_for_its_place(Mission& mission, const Situation& seen, Time /*now*/) {
  const bool stands_and_talks =  // first things first
      seen.activity == Activity::farewell || (seen.activity == Activity::visit && !seen.may_interrupt);
  if (seen.is_lost && seen.activity != Activity::relocalize && !stands_and_talks) mission.relocalize();
  return Round::is_over;
}

Round resume(Mission& mission, const Situation& seen, Time now) {
  if (!seen.is_settled) return Round::is_over;
  const bool was_suspended = seen.activity == Activity::relocalize && seen.has_visit;
  mission.end_relocalizing(now);
  if (was_suspended) mission.order_visit(now);
  return Round::goes_on;
}

Round break_off(Mission& mission, const Situation& /*seen*/, Time now) {
  mission.break_off_to_charge(now);
  return rest(mission, mission.situation(now), now);
}

Round next_visit(Mission& mission, const Situation& /*seen*/, Time now) {
  return mission.begin_visit(now) ? Round::is_over : Round::goes_on;
}

Round charge_between_tours(Mission& mission, const Situation& /*seen*/, Time now) {
  mission.need_charge("between tours", now);
  return Round::goes_on;
}

Round charge_first(Mission& mission, const Situation& /*seen*/, Time now) {
  mission.need_charge("for what comes next", now);
  return Round::goes_on;
}

constexpr std::array kRoutines{
    // lost
    Routine{[](const Situation& seen) { return !seen.is_localized; }, look_for_its_place},
    // found
    Routine{[](const Situation& seen) { return seen.activity == Activity::relocalize || !seen.was_ever_localized; },
            resume},
    // farewell under way
    Routine{[](const Situation& seen) { return seen.activity == Activity::farewell; },
            [](Mission&, const Situation&, Time) { return Round::is_over; }},
    // battery low
    Routine{[](const Situation& seen) {
              const bool may_end = seen.activity != Activity::visit || seen.may_interrupt;
              return seen.must_charge && (seen.has_visit || seen.has_tour) && may_end;
            },
            break_off},
    // visit under way
    Routine{[](const Situation& seen) { return seen.activity == Activity::visit; },
            [](Mission&, const Situation&, Time) { return Round::is_over; }},
    // battery low soon
    Routine{[](const Situation& seen) {
              return seen.is_low_soon && !seen.must_charge && seen.has_charger && !seen.has_tour && !seen.has_farewell;
            },
            charge_between_tours},
    // next visit
    Routine{[](const Situation& seen) { return seen.may_serve; }, next_visit},
    // farewell
    Routine{[](const Situation& seen) { return seen.has_farewell; },
            [](Mission& mission, const Situation&, Time) {
              mission.say_farewell();
              return Round::is_over;
            }},
    // charge first
    Routine{[](const Situation& seen) { return !seen.must_charge && seen.is_anything_due; }, charge_first},
    // mingle
    Routine{[](const Situation& seen) { return seen.may_mingle && !seen.charges; },
            [](Mission& mission, const Situation&, Time now) {
              mission.mingle(now);
              return Round::is_over;
            }},
    // rest
    Routine{[](const Situation&) { return true; }, rest},
};

}  // namespace

void PlanController::decide(Mission& mission, Time now) {
  Situation seen = mission.situation(now);
  for (const Routine& routine : kRoutines) {
    if (!routine.applies(seen)) continue;
    if (routine.act(mission, seen, now) == Round::is_over) return;
    seen = mission.situation(now);
  }
}

}  // namespace docent::task_control
