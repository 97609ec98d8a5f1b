#include "docent/task_control/mission/mission_params.h"

namespace docent::task_control {

Result<void> MissionParams::validate() const {
  if (auto valid = schedule.validate(); !valid) return valid;
  if (!(lost_after_s >= 0.0)) return fail("mission.lost_after_s must be >= 0");
  if (!(localized_after_s >= 0.0)) return fail("mission.localized_after_s must be >= 0");
  if (!(at_home_m > 0.0)) return fail("mission.at_home_m must be > 0");
  if (!(home_retry_s >= 0.0)) return fail("mission.home_retry_s must be >= 0");
  if (!(battery_low >= 0.0 && battery_low <= 1.0)) return fail("mission.battery_low must be in 0..1");
  if (!(reserve_of_begun >= 0.0 && reserve_of_begun <= 1.0)) return fail("mission.reserve_of_begun must be in 0..1");
  if (!(battery_full > battery_low && battery_full <= 1.0))
    return fail("mission.battery_full must be in battery_low..1");
  if (!(at_charger_m > 0.0)) return fail("mission.at_charger_m must be > 0");
  if (!(contact_s >= 0.0)) return fail("mission.contact_s must be >= 0");
  if (!(battery_gain >= 0.0 && battery_gain <= 1.0)) return fail("mission.battery_gain must be in 0..1");
  if (!(battery_soon >= 0.0 && battery_soon <= battery_low + battery_gain))
    return fail("mission.battery_soon must be in 0..battery_low + battery_gain");
  if (!(mingle_pause_s >= 0.0)) return fail("mission.mingle_pause_s must be >= 0");
  if (vote_every < 1) return fail("mission.vote_every must be >= 1");
  if (!(vote_idle_s >= 0.0)) return fail("mission.vote_idle_s must be >= 0");
  if (!(drain_per_s > 0.0)) return fail("mission.drain_per_s must be > 0");
  if (!(charge_per_s > 0.0)) return fail("mission.charge_per_s must be > 0");
  if (auto valid = charging.validate(); !valid) return fail("mission." + valid.error().message);
  if (auto valid = staff.validate(); !valid) return fail("mission." + valid.error().message);
  return {};
}

}  // namespace docent::task_control
