#include "docent/localization/judgement/part_sums.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {

std::uint64_t part_at(Point2 in_map, double side, bool is_wall) {
  const auto column = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(in_map.x / side)));
  const auto row = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(in_map.y / side)));
  return (std::uint64_t{column} << 32) ^ (std::uint64_t{row} << 1) ^ std::uint64_t{is_wall ? 1U : 0U};
}

bool is_wall(std::uint64_t part) { return (part & 1U) != 0; }

void PartSums::change(const PartCost& by, int count) {
  Sum& sum = parts_[by.part];
  double& cost = is_wall(by.part) ? walls_ : floor_;
  const auto share = [&] { return sum.cost / (sum.count + prior_beams_); };
  cost -= share();
  sum.cost = std::max(0.0, sum.cost + count * static_cast<double>(by.cost));
  sum.count += count;
  if (sum.count <= 0) {
    parts_.erase(by.part);
    return;
  }
  cost += share();
}

void PartSums::add(std::span<const PartCost> costs) {
  for (const PartCost& cost : costs) change(cost, 1);
}

void PartSums::take_out(std::span<const PartCost> costs) {
  for (const PartCost& cost : costs) change(cost, -1);
}

}  // namespace docent::localization
