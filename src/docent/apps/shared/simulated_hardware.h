#pragma once

#include "docent/robot/robot_config.h"
#include "docent/simulator/eye_drivers.h"
#include "docent/simulator/hardware.h"
#include "docent/simulator/scenario/build_errors.h"

namespace docent::apps {

/// The sensors that a simulated robot is built with: those of the body as configured.
[[nodiscard]] simulator::Hardware simulated_hardware(const robot::RobotBody& body);

/// The eyes likewise: none, where robot.yaml has none. Error: a fault of these sections.
[[nodiscard]] Result<simulator::EyeOptions> simulated_eyes(const robot::RobotConfig& config);

/// As it was truly built. Error: a scanner that the body does not have.
[[nodiscard]] Result<void> build_wrongly(simulator::Hardware& hardware, const simulator::BuildErrors& errors);

}  // namespace docent::apps
