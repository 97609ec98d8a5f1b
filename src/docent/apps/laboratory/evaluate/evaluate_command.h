#pragma once

namespace CLI {
class App;
}

namespace docent::apps::evaluate_command {

void add_evaluate_command(CLI::App& app);

}  // namespace docent::apps::evaluate_command
