#pragma once

#include <memory>

#include "docent/apps/shared/robot_maker.h"

namespace CLI {
class App;
}

namespace docent::apps::simulate_command {

/// `docent explore`.
void add_explore_command(CLI::App& app, std::shared_ptr<RobotMaker> robot);

}  // namespace docent::apps::simulate_command
