#include "docent/task_control/tour_scheduler/composition.h"

#include <algorithm>

namespace docent {

Result<void> SchedulerParams::validate() const {
  if (max_open < 1) return fail("mission.max_open must be >= 1");
  if (!(overdue_s > 0.0)) return fail("mission.overdue_s must be > 0");
  if (max_attempts < 1) return fail("mission.max_attempts must be >= 1");
  if (!(retry_delay_s >= 0.0)) return fail("mission.retry_delay_s must be >= 0");
  if (!(max_detour_m >= 0.0)) return fail("mission.max_detour_m must be >= 0");
  if (!(cruise_speed > 0.0)) return fail("mission.cruise_speed must be > 0");
  if (!(stop_overhead_s >= 0.0)) return fail("mission.stop_overhead_s must be >= 0");
  if (max_skipped < 0) return fail("mission.max_skipped must be >= 0");
  return {};
}

std::vector<std::string> compose_tour(const Programme& programme, Point2 start, double target_s,
                                      const TravelDistance& travel, const SchedulerParams& params) {
  std::vector<std::string> chosen;
  Point2 at = start;
  double left_s = target_s;
  while (chosen.size() < programme.exhibits.size()) {
    const ProgrammeExhibit* best = nullptr;
    double best_way = 0.0;
    for (const ProgrammeExhibit& exhibit : programme.exhibits) {
      if (exhibit.web_only || std::find(chosen.begin(), chosen.end(), exhibit.id) != chosen.end()) continue;
      const double way = travel(at, exhibit.pose.position());
      const double cost_s = way / params.cruise_speed + exhibit.speech_s + params.stop_overhead_s;
      if (cost_s > left_s && !chosen.empty()) continue;
      if (best == nullptr || way < best_way) {
        best = &exhibit;
        best_way = way;
      }
    }
    if (best == nullptr) break;
    chosen.push_back(best->id);
    left_s -= best_way / params.cruise_speed + best->speech_s + params.stop_overhead_s;
    at = best->pose.position();
  }
  return chosen;
}

}  // namespace docent
