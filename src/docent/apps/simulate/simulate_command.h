#pragma once

namespace CLI {
class App;
}

namespace docent::apps::simulate_command {

/// `docent simulate`: the whole robot in virtual time, with the deployment report.
void add_simulate_command(CLI::App& app);

}  // namespace docent::apps::simulate_command
