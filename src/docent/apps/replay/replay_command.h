#pragma once

#include <memory>

#include "docent/apps/shared/robot_maker.h"

namespace CLI {
class App;
}

namespace docent::apps::replay_command {

void add_replay_command(CLI::App& app, std::shared_ptr<RobotMaker> robot);

}  // namespace docent::apps::replay_command
