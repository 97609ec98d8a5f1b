#pragma once

namespace CLI {
class App;
}

namespace docent::apps::museum_command {

/// `docent check MUSEUM_DIR`
void add_check_command(CLI::App& app);

}  // namespace docent::apps::museum_command
