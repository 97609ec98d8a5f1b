#pragma once

#include <string>
#include <vector>

#include "docent/robot/robot_config.h"

namespace docent::robot {

/// What of a body is allowed and yet likely a slip: a heading that looks like radians. For a person, with the key's
/// name.
[[nodiscard]] std::vector<std::string> body_notes(const RobotBody& body);

}  // namespace docent::robot
