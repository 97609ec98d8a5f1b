#include "docent/robot/body_notes.h"

#include <cstdio>
#include <numbers>

#include "docent/geometry/unit_slip.h"

namespace docent::robot {

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
