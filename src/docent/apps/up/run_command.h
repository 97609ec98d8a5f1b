#pragma once

namespace CLI {
class App;
}

namespace docent::apps::up_command {

/// `docent run MODULE`: one module as a process of its own.
void add_run_command(CLI::App& app);

}  // namespace docent::apps::up_command
