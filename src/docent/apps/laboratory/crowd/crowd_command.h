#pragma once

#include <memory>

#include "docent/apps/shared/robot_maker.h"

namespace CLI {
class App;
}

namespace docent::apps::crowd_command {

/// `docent-lab crowd --seed N --density 0.8 --ignoring 0.5 --method cautious_window`
void add_crowd_command(CLI::App& app, std::shared_ptr<RobotMaker> robot);

}  // namespace docent::apps::crowd_command
