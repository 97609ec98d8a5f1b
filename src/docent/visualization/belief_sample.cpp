#include "docent/visualization/belief_sample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace docent::visualization {
namespace {

/// The i-th point in the unit cube of a sequence that fills it evenly: the multiples of powers of the root of
/// x^4 = x + 1, which generalizes the golden ratio to three dimensions.
struct Spot {
  explicit Spot(int i) {
    constexpr double kRoot = 1.2207440846057596;
    const auto part = [i](double step) {
      const double value = 0.5 + static_cast<double>(i) * step;
      return value - std::floor(value) - 0.5;
    };
    x = part(1.0 / kRoot);
    y = part(1.0 / (kRoot * kRoot));
    turn = part(1.0 / (kRoot * kRoot * kRoot));
  }
  double x, y, turn;  ///< -0.5..0.5
};

double mass_of(float field) { return std::max(0.0, static_cast<double>(field)); }

Pose2 in_cell(const docent_msgs::Belief& belief, const docent_msgs::BeliefCell& cell, const Spot& spot) {
  const auto side = static_cast<double>(belief.cell_size);
  const auto step = static_cast<double>(belief.heading_step);
  return {static_cast<double>(cell.x) + spot.x * side, static_cast<double>(cell.y) + spot.y * side,
          Angle::radians(static_cast<double>(cell.theta) + spot.turn * step)};
}

Pose2 in_square(const docent_msgs::CoarseBelief& rest, std::size_t index, const Spot& spot) {
  const std::size_t columns = std::max<std::size_t>(rest.columns, 1);
  const auto side = static_cast<double>(rest.cell_size);
  return {static_cast<double>(rest.origin_x) + (static_cast<double>(index % columns) + 0.5 + spot.x) * side,
          static_cast<double>(rest.origin_y) + (static_cast<double>(index / columns) + 0.5 + spot.y) * side,
          Angle::radians(spot.turn * 2.0 * std::numbers::pi)};
}

}  // namespace

std::vector<Pose2> belief_sample(const docent_msgs::Belief& belief, int count) {
  const auto& cells = belief.cells;
  const auto& squares = belief.rest.mass;
  const auto mass_at = [&](std::size_t i) {
    return mass_of(i < cells.size() ? cells[i].mass : squares[i - cells.size()]);
  };
  double total = 0.0;
  for (std::size_t i = 0; i < cells.size() + squares.size(); ++i) total += mass_at(i);
  std::vector<Pose2> sample;
  if (!(total > 0.0)) return sample;
  sample.reserve(static_cast<std::size_t>(count));
  // Low variance: equal steps of mass from the first state to the last.
  double passed = 0.0;
  for (std::size_t i = 0; i < cells.size() + squares.size(); ++i) {
    passed += mass_at(i);
    while (static_cast<int>(sample.size()) < count &&
           (static_cast<double>(sample.size()) + 0.5) * total < passed * count) {
      const Spot spot{static_cast<int>(sample.size())};
      sample.push_back(i < cells.size() ? in_cell(belief, cells[i], spot)
                                        : in_square(belief.rest, i - cells.size(), spot));
    }
  }
  return sample;
}

}  // namespace docent::visualization
