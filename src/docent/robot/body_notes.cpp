#include "docent/robot/body_notes.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace docent::robot {
namespace {

/// Whether that many degrees are rather a whole share of a turn in radians, as 3.14159, -1.5708 and 2.356 are: no mount
/// is said to a hundredth of a degree.
bool looks_like_radians(double degrees) {
  constexpr double kStep = std::numbers::pi / 12.0;  // 15 degrees
  constexpr double kRounded = 0.006;                 // to two digits behind the point, as 1.57 is
  const double steps = degrees / kStep;
  const bool is_whole_number = std::abs(degrees - std::round(degrees)) < 1e-9;
  return !is_whole_number && std::abs(degrees) < 2.0 * std::numbers::pi + kRounded &&
         std::abs(steps - std::round(steps)) * kStep < kRounded && std::abs(steps) > 2.5;
}

}  // namespace

std::vector<std::string> body_notes(const RobotBody& body) {
  std::vector<std::string> notes;
  for (const Scanner& scanner : body.scanners) {
    if (!looks_like_radians(scanner.heading)) continue;
    char text[160];
    std::snprintf(text, sizeof text,
                  "body.scanners, %s: a heading of %g is read as degrees; if radians are meant, write %.0f",
                  scanner.name.c_str(), scanner.heading, scanner.heading * 180.0 / std::numbers::pi);
    notes.emplace_back(text);
  }
  return notes;
}

}  // namespace docent::robot
