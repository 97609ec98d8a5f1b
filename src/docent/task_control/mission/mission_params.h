#pragma once

#include "docent/base/result.h"
#include "docent/task_control/mission/charge_plan.h"
#include "docent/task_control/mission/staff_call.h"
#include "docent/task_control/tour_scheduler/scheduler_params.h"

namespace docent::task_control {

/// Section `mission` of robot.yaml.
struct MissionParams {
  SchedulerParams schedule;
  double lost_after_s = 3.0;       ///< [s] >= 0 without localization before a tour is suspended
  double localized_after_s = 1.0;  ///< [s] >= 0 with localization before it is resumed
  double at_home_m = 0.7;          ///< [m] > 0: so near, the robot is at home
  double home_retry_s = 30.0;      ///< [s] >= 0 after a failed way home
  double at_charger_m = 0.3;       ///< [m] > 0: so near, it is at a charger whose battery does not say that it charges
  double contact_s = 10.0;    ///< [s] >= 0 after it has docked, before a charger that does not charge is tried again
  double battery_low = 0.15;  ///< 0..1: still left on arrival at its charger
  /// 0..1 of battery_low must be left for what has begun: a tour is rather finished than given twice.
  double reserve_of_begun = 0.5;
  /// 0..1: with less it charges between two tours, before it must, though somebody waits. Below what it charges to.
  double battery_soon = 0.25;
  double battery_full = 0.95;  ///< 0..1, > battery_low: charged; the last part takes real batteries long
  /// 0..1: what makes the way to the charger worth while. An idle robot goes there when so much is missing; people
  /// who wait are served again when there is so much more than battery_low.
  double battery_gain = 0.25;
  bool goes_home = true;  ///< when nobody wants anything; false: it stays, for whoever sends it about from elsewhere
  bool mingles = true;    ///< attracts people while it rests at home and nobody wants anything
  double mingle_pause_s = 30.0;  ///< [s] >= 0 between two phases: who listens may choose
  int vote_every = 3;            ///< >= 1: of so many tours one is the Web's, if there are votes ([Minerva2000] 6.4)
  double vote_idle_s = 120.0;    ///< [s] >= 0 after the first vote a robot at home gives it though it is not its turn
  double drain_per_s = 1.4e-4;   ///< [1/s] > 0 share of a full battery: two hours of driving; more is measured
  double charge_per_s = 2.2e-4;  ///< [1/s] > 0 likewise: 75 minutes; measured while it charges
  ChargePlanParams charging;     ///< when it charges
  StaffCallParams staff;         ///< when it calls for help, because it does not get its charge
  template <class V>
  void visit(V& v) {
    schedule.visit(v);
    v("lost_after_s", lost_after_s);
    v("localized_after_s", localized_after_s);
    v("at_home_m", at_home_m);
    v("home_retry_s", home_retry_s);
    v("at_charger_m", at_charger_m);
    v("contact_s", contact_s);
    v("battery_low", battery_low);
    v("reserve_of_begun", reserve_of_begun);
    v("battery_soon", battery_soon);
    v("battery_full", battery_full);
    v("battery_gain", battery_gain);
    v("goes_home", goes_home);
    v("mingles", mingles);
    v("mingle_pause_s", mingle_pause_s);
    v("vote_every", vote_every);
    v("vote_idle_s", vote_idle_s);
    v("drain_per_s", drain_per_s);
    v("charge_per_s", charge_per_s);
    v("charging", charging);
    v("staff", staff);
  }
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace docent::task_control
