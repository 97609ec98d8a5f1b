#include "docent/apps/shared/simulated_hardware.h"

#include <numbers>

namespace docent::apps {

simulator::Hardware simulated_hardware(const robot::RobotBody& body) {
  simulator::Hardware hardware;
  hardware.scanners.clear();
  for (const robot::Scanner& scanner : body.scanners) {
    hardware.scanners.push_back(
        {scanner.name, scanner.frame, scanner.base_from_sensor(), scanner.field * std::numbers::pi / 180.0});
  }
  hardware.sonars = body.sonars;
  hardware.sonar_radius = body.sonar_radius;
  hardware.infrareds = body.infrareds;
  hardware.infrared_radius = body.infrared_radius;
  hardware.has_tactile = body.tactile;
  return hardware;
}

}  // namespace docent::apps
