#pragma once

namespace CLI {
class App;
}

namespace docent::apps::score_map_command {

/// `docent-lab score-map`: how far a learned map is from the true world that a simulator knows.
void add_score_map_command(CLI::App& app);

}  // namespace docent::apps::score_map_command
