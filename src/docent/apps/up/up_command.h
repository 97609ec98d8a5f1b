#pragma once

namespace CLI {
class App;
}

namespace docent::apps::up_command {

/// `docent up`: every module as a process of its own, supervised.
void add_up_command(CLI::App& app);

}  // namespace docent::apps::up_command
