#pragma once

namespace CLI {
class App;
}

namespace docent::apps::replay_command {

void add_replay_command(CLI::App& app);

}  // namespace docent::apps::replay_command
