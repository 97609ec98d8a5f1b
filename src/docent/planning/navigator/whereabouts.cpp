#include "docent/planning/navigator/whereabouts.h"

namespace docent::planning {
namespace {

constexpr Duration kBeliefStaleAfter = std::chrono::seconds{3};

}  // namespace

std::optional<Pose2> Whereabouts::map_from_base() const {
  if (!map_from_odom || !odom_from_base) return std::nullopt;
  return *map_from_odom * *odom_from_base;
}

bool Whereabouts::is_known(Time now) const { return is_localized && now - believed_at < kBeliefStaleAfter; }

}  // namespace docent::planning
