#pragma once

#include <string>
#include <vector>

namespace docent::pictures {

/// A mark on an axis or a colour bar, and what stands beside it.
struct Tick {
  double at = 0.0;
  std::string label;
};

/// The round numbers in [low, high] that are 1, 2 or 5 times a power of ten apart: as many as there can be, but at most
/// `most`. @pre low < high, both finite; most >= 2
[[nodiscard]] std::vector<Tick> round_ticks(double low, double high, int most);

/// The powers of ten in [low, high], written as 10⁻³. @pre 0 < low < high
[[nodiscard]] std::vector<Tick> power_ticks(double low, double high);

}  // namespace docent::pictures
