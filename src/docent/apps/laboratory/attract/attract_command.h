#pragma once

#include <memory>

#include "docent/apps/shared/robot_maker.h"

namespace CLI {
class App;
}

namespace docent::apps::attract_command {

/// `docent-lab attract --seed N --taste friendly --trials 201 --report r.json --picture styles.svg`
void add_attract_command(CLI::App& app, std::shared_ptr<RobotMaker> robot);

}  // namespace docent::apps::attract_command
