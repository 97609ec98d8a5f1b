#include "docent/collision_avoidance/watches/complaint.h"

#include <algorithm>
#include <utility>

namespace docent::collision_avoidance {

std::optional<Complaint> worse(std::optional<Complaint> a, std::optional<Complaint> b) {
  if (!a) return b;
  if (!b) return a;
  return b->max_speed < a->max_speed ? std::move(b) : std::move(a);
}

std::optional<Complaint> complaint_of(const Freshness& freshness, Time now, const std::string& name,
                                      const ComplaintParams& params) {
  if (freshness.lateness() > params.late)
    return Complaint{freshness.is_stale(now, params.patience) ? 0.0 : params.crippled_speed,
                     "the " + name + " comes late"};
  if (freshness.is_stale(now, params.patience)) return Complaint{0.0, "no fresh " + name};
  return std::nullopt;
}

}  // namespace docent::collision_avoidance
