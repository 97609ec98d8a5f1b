#pragma once

#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/robot/robot_config.h"

namespace CLI {
class App;
}

namespace docent::apps::config_command {

/// `docent config`: every key of robot.yaml with its value, unit and meaning, as a robot.yaml.
void add_config_command(CLI::App& app);

/// The text of it. @param sections  those to show; empty: all. Error: an unknown section, or what is wrong in `config`.
[[nodiscard]] Result<std::string> commented_config(const robot::RobotConfig& config,
                                                   const std::vector<std::string>& sections);

/// Paths of the keys whose struct says nothing of them: there should be none.
[[nodiscard]] std::vector<std::string> keys_without_meaning(const robot::RobotConfig& config);

}  // namespace docent::apps::config_command
