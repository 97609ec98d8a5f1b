#include "docent/task_control/mission/charge_plan.h"

#include <set>
#include <string>
#include <utility>

namespace docent::task_control {

Result<void> ChargePlanParams::validate() const {
  if (!(busy_share >= 0.0 && busy_share <= 1.0)) return fail("charging.busy_share must be in 0..1");
  if (!(gap_missing > 0.0 && gap_missing <= 1.0)) return fail("charging.gap_missing must be in 0..1, and not 0");
  if (!(least_gain >= 0.0 && least_gain <= 1.0)) return fail("charging.least_gain must be in 0..1");
  if (!(visit_s > 0.0)) return fail("charging.visit_s must be > 0");
  if (!(tour_s > 0.0)) return fail("charging.tour_s must be > 0");
  if (!(spare_factor >= 1.0)) return fail("charging.spare_factor must be >= 1");
  if (!(rises > 1.0)) return fail("charging.rises must be > 1");
  if (few < 0) return fail("charging.few must be >= 0");
  return {};
}

Waiting waiting_on(const RequestBoard& board) {
  std::set<std::string> exhibits;
  std::set<std::string> tours;
  for (const BoardEntry& entry : board.entries()) {
    if (entry.status != RequestStatus::queued) continue;
    const bool is_tour = entry.request.kind == RequestKind::tour;
    (is_tour ? tours : exhibits).insert(entry.request.target + "/" + std::to_string(entry.request.viewpoint));
  }
  return {static_cast<int>(exhibits.size()), static_cast<int>(tours.size())};
}

double ChargePlan::missing_in_gap(double usual) const {
  const double share = std::max(demand_.share(hour_), demand_.share((hour_ + 1) % 24));
  return params_.in_gaps && share >= params_.busy_share ? std::min(usual, params_.gap_missing) : usual;
}

double ChargePlan::gain_for(const Waiting& waiting, double most, double drain_per_s) const {
  if (!params_.in_gaps) return most;
  const double busy_s = waiting.exhibits * params_.visit_s + waiting.tours * params_.tour_s;
  return std::clamp(params_.spare_factor * drain_per_s * busy_s, std::min(params_.least_gain, most), most);
}

bool ChargePlan::may_charge_before(const Waiting& waiting) const {
  if (!params_.in_gaps || waiting.all() == 0) return true;
  const bool rises = demand_.share((hour_ + 1) % 24) >= params_.rises * demand_.share(hour_);
  return rises && waiting.all() <= params_.few;
}

}  // namespace docent::task_control
