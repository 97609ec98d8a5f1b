#pragma once

namespace CLI {
class App;
}

namespace docent::apps::learn_command {

/// `docent-lab learn-sensor-model`: sensor and motion models from recordings.
void add_learn_command(CLI::App& app);

}  // namespace docent::apps::learn_command
