#pragma once

#include "docent/apps/shared/program.h"

namespace docent::apps::laboratory {

/// `docent-lab`: what measures the robot and what its models are learned with. None of it runs a robot.
[[nodiscard]] Program docent_lab(const std::string& version);

}  // namespace docent::apps::laboratory
