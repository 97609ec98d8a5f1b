#pragma once

#include <cmath>
#include <numbers>

namespace docent {

/// Whether that many degrees are rather a whole share of a turn in radians, as 3.14159, -1.5708 and 2.356 are: nobody
/// says a heading to a hundredth of a degree.
[[nodiscard]] inline bool looks_like_radians(double degrees) {
  constexpr double kStep = std::numbers::pi / 12.0;  // 15 degrees
  constexpr double kRounded = 0.006;                 // to two digits behind the point, as 1.57 is
  const double steps = degrees / kStep;
  const bool is_whole_number = std::abs(degrees - std::round(degrees)) < 1e-9;
  return !is_whole_number && std::abs(degrees) < 2.0 * std::numbers::pi + kRounded &&
         std::abs(steps - std::round(steps)) * kStep < kRounded && std::abs(steps) > 2.5;
}

}  // namespace docent
