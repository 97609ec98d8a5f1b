#include "docent/task_control/tour_scheduler/scheduler_params.h"

#include <algorithm>
#include <cmath>

namespace docent::task_control {

Result<void> SchedulerParams::validate() const {
  if (max_stops < 1) return fail("mission.max_stops must be >= 1");
  if (max_open < 1) return fail("mission.max_open must be >= 1");
  if (max_points < 1) return fail("mission.max_points must be >= 1");
  if (!(overdue_s > 0.0)) return fail("mission.overdue_s must be > 0");
  if (!(overdue_per_stop_s >= 0.0)) return fail("mission.overdue_per_stop_s must be >= 0");
  if (!(hurry_after_s > 0.0)) return fail("mission.hurry_after_s must be > 0");
  if (max_attempts < 1) return fail("mission.max_attempts must be >= 1");
  if (!(retry_delay_s >= 0.0)) return fail("mission.retry_delay_s must be >= 0");
  if (!(retry_most_s >= retry_delay_s)) return fail("mission.retry_most_s must be >= retry_delay_s");
  if (max_stop_attempts < 1) return fail("mission.max_stop_attempts must be >= 1");
  if (!(max_detour_m >= 0.0)) return fail("mission.max_detour_m must be >= 0");
  if (max_skipped < 0) return fail("mission.max_skipped must be >= 0");
  if (!(wait_for_group_s >= 0.0)) return fail("mission.wait_for_group_s must be >= 0");
  if (auto valid = travel_times.validate(); !valid) return valid;
  return composition.validate();
}

double SchedulerParams::retry_after(int attempts) const {
  return std::min(retry_most_s, std::ldexp(retry_delay_s, attempts - 1));
}

}  // namespace docent::task_control
