#pragma once

#include "docent/robot/robot_config.h"
#include "docent/simulator/hardware.h"

namespace docent {

/// The sensors that a simulated robot is built with: those of the body as configured.
[[nodiscard]] simulator::Hardware simulated_hardware(const RobotBody& body);

}  // namespace docent
