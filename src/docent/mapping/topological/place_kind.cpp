#include "docent/mapping/topological/place_kind.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace docent::mapping {
namespace {

double unlikeness(const PlaceShape& a, const PlaceShape& b) {
  const double width = std::log(a.width / b.width);
  const double elongation = std::log(a.elongation / b.elongation);
  const double doors = std::log((1.0 + a.doors) / (1.0 + b.doors));
  return width * width + elongation * elongation + doors * doors;
}

}  // namespace

PlaceKind kind_of(const PlaceShape& shape, std::span<const PlaceExample> examples, int nearest) {
  std::vector<std::pair<double, PlaceKind>> order;
  for (const PlaceExample& example : examples) order.emplace_back(unlikeness(shape, example.shape), example.kind);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  order.resize(std::min(order.size(), static_cast<std::size_t>(nearest)));
  const auto hallways =
      std::count_if(order.begin(), order.end(), [](const auto& one) { return one.second == PlaceKind::hallway; });
  return 2 * static_cast<std::size_t>(hallways) > order.size() ? PlaceKind::hallway : PlaceKind::room;
}

}  // namespace docent::mapping
