#include "docent/collision_avoidance/plausibility/repeated_sweeps.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace docent::collision_avoidance {
namespace {

/// FNV-1a over the words of the ranges.
std::uint64_t hash_of(std::span<const float> ranges) {
  std::uint64_t hash = 14695981039346656037U;
  for (const float range : ranges) hash = (hash ^ std::bit_cast<std::uint32_t>(range)) * 1099511628211U;
  return hash;
}

}  // namespace

std::optional<double> RepeatedSweeps::add(Time stamp, std::span<const float> ranges, int answers,
                                          const Pose2& odom_from_base) {
  while (!sweeps_.empty() && stamp - sweeps_.front().stamp > seconds(params_.memory)) sweeps_.pop_front();
  const std::uint64_t hash = hash_of(ranges);
  const auto again = std::find_if(sweeps_.rbegin(), sweeps_.rend(), [&](const Sweep& old) { return old.hash == hash; });
  std::optional<double> age;
  if (again != sweeps_.rend() && again != sweeps_.rbegin() && answers >= params_.least_readings) {
    const Pose2 moved = inverse(again->odom_from_base) * odom_from_base;
    if (norm(moved.position()) > params_.least_way || std::abs(moved.theta.radians()) > params_.least_turn)
      age = to_seconds(stamp - again->stamp);
  }
  row_ = age ? row_ + 1 : 0;
  // A repeated sweep stands where it was first met: else a loop of old ones would look ever younger.
  if (again == sweeps_.rend() || again == sweeps_.rbegin()) sweeps_.push_back({hash, stamp, odom_from_base});
  return row_ >= params_.in_a_row ? age : std::nullopt;
}

}  // namespace docent::collision_avoidance
