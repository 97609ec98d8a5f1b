#pragma once

namespace CLI {
class App;
}

namespace docent::apps {

/// `docent learn-sensor-model`: sensor and motion models from recordings.
void add_learn_command(CLI::App& app);

}  // namespace docent::apps
