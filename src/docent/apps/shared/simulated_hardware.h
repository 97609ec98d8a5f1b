#pragma once

#include "docent/robot/robot_config.h"
#include "docent/simulator/hardware.h"

namespace docent::apps {

/// The sensors that a simulated robot is built with: those of the body as configured.
[[nodiscard]] simulator::Hardware simulated_hardware(const robot::RobotBody& body);

}  // namespace docent::apps
