#include "docent/simulator/sensing/camera/optics/shake.h"

#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::simulator {

Shake::Shake(double most, std::uint64_t seed) {
  constexpr std::array kShares{0.5, 0.3, 0.2};
  constexpr std::array<std::array<double, 2>, 3> kHertz{{{0.8, 2.0}, {3.0, 6.0}, {7.0, 13.0}}};
  Rng rng = Rng{seed}.stream("shake");
  for (auto& axis : swings_)
    for (std::size_t i = 0; i < axis.size(); ++i)
      axis[i] = {kShares[i] * most, 2.0 * std::numbers::pi * rng.uniform(kHertz[i][0], kHertz[i][1]),
                 rng.uniform(0.0, 2.0 * std::numbers::pi)};
}

Lean Shake::at(double time) const {
  const auto sum = [&](const std::array<Swing, 3>& axis) {
    double angle = 0.0;
    for (const Swing& swing : axis) angle += swing.size * std::sin(swing.rate * time + swing.phase);
    return angle;
  };
  return {sum(swings_[0]), sum(swings_[1])};
}

}  // namespace docent::simulator
