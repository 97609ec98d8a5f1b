#pragma once

namespace CLI {
class App;
}

namespace docent::apps::state_command {

/// docent state check|backup|restore
void add_state_command(CLI::App& app);

}  // namespace docent::apps::state_command
