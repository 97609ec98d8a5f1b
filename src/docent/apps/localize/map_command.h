#pragma once

namespace CLI {
class App;
}

namespace docent::apps::localize_command {

/// `docent map`: a map from a recorded log.
void add_map_command(CLI::App& app);

}  // namespace docent::apps::localize_command
