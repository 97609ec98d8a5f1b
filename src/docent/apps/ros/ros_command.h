#pragma once

namespace CLI {
class App;
}

namespace docent::apps::ros {

/// `docent ros check`
void add_ros_command(CLI::App& app);

}  // namespace docent::apps::ros
