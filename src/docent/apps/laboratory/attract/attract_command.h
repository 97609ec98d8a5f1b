#pragma once

namespace CLI {
class App;
}

namespace docent::apps::attract_command {

/// `docent-lab attract --seed N --taste friendly --trials 201 --report r.json --picture styles.svg`
void add_attract_command(CLI::App& app);

}  // namespace docent::apps::attract_command
