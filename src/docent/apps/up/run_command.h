#pragma once

#include <memory>

namespace CLI {
class App;
}

namespace docent::apps {
class RobotMaker;
}

namespace docent::apps::up_command {

/// `docent run MODULE`: one module as a process of its own, of the robot that `maker` makes.
void add_run_command(CLI::App& app, std::shared_ptr<RobotMaker> maker);

}  // namespace docent::apps::up_command
