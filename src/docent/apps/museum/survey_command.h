#pragma once

namespace CLI {
class App;
}

namespace docent::apps::museum_command {

/// `docent survey --world simulation.yaml --seed N --out DIR`
void add_survey_command(CLI::App& app);

}  // namespace docent::apps::museum_command
