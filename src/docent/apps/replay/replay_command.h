#pragma once

namespace CLI {
class App;
}

namespace docent {

void add_replay_command(CLI::App& app);

}  // namespace docent
