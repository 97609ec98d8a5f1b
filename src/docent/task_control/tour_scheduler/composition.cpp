#include "docent/task_control/tour_scheduler/composition.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::task_control {

Result<void> SchedulerParams::validate() const {
  if (max_stops < 1) return fail("mission.max_stops must be >= 1");
  if (max_open < 1) return fail("mission.max_open must be >= 1");
  if (!(overdue_s > 0.0)) return fail("mission.overdue_s must be > 0");
  if (!(hurry_after_s > 0.0)) return fail("mission.hurry_after_s must be > 0");
  if (max_attempts < 1) return fail("mission.max_attempts must be >= 1");
  if (!(retry_delay_s >= 0.0)) return fail("mission.retry_delay_s must be >= 0");
  if (!(retry_most_s >= retry_delay_s)) return fail("mission.retry_most_s must be >= retry_delay_s");
  if (max_stop_attempts < 1) return fail("mission.max_stop_attempts must be >= 1");
  if (!(max_detour_m >= 0.0)) return fail("mission.max_detour_m must be >= 0");
  if (!(cruise_speed > 0.0)) return fail("mission.cruise_speed must be > 0");
  if (!(stop_overhead_s >= 0.0)) return fail("mission.stop_overhead_s must be >= 0");
  if (max_skipped < 0) return fail("mission.max_skipped must be >= 0");
  return {};
}

double SchedulerParams::retry_after(int attempts) const {
  return std::min(retry_most_s, std::ldexp(retry_delay_s, attempts - 1));
}

double stop_duration(const ProgrammeExhibit& exhibit, double way_m, const SchedulerParams& params) {
  return way_m / params.cruise_speed + exhibit.speech_s + params.stop_overhead_s;
}

std::vector<std::string> compose_tour(const Programme& programme, Point2 start, double left_s, const StopChoice& choice,
                                      const TravelDistance& travel, const SchedulerParams& params) {
  const auto holds = [](const std::vector<std::string>& list, const std::string& id) {
    return std::find(list.begin(), list.end(), id) != list.end();
  };
  std::vector<std::string> chosen;
  Point2 at = start;
  const ProgrammeExhibit* before = programme.find_exhibit(choice.after);
  while (true) {
    const ProgrammeExhibit* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    double way_m = 0.0;
    for (const ProgrammeExhibit& exhibit : programme.exhibits) {
      if (exhibit.web_only || holds(chosen, exhibit.id) || holds(choice.done, exhibit.id)) continue;
      const double way = travel(at, exhibit.pose.position());
      double felt = holds(choice.wished, exhibit.id) ? kWishedFactor * way : way;
      if (before != nullptr && holds(before->next, exhibit.id)) felt *= kSensibleFactor;
      if (felt < least) {
        nearest = &exhibit;
        least = felt;
        way_m = way;
      }
    }
    if (nearest == nullptr) return chosen;
    const double cost_s = stop_duration(*nearest, way_m, params);
    if (cost_s > 2.0 * left_s) return chosen;
    chosen.push_back(nearest->id);
    left_s -= cost_s;
    at = nearest->pose.position();
    before = nearest;
  }
}

}  // namespace docent::task_control
