#pragma once

namespace CLI {
class App;
}

namespace docent::apps::simulate_command {

/// `docent explore`.
void add_explore_command(CLI::App& app);

}  // namespace docent::apps::simulate_command
