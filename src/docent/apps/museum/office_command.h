#pragma once

namespace CLI {
class App;
}

namespace docent::apps::museum_command {

/// `docent office --seed N --out DIR`
void add_office_command(CLI::App& app);

}  // namespace docent::apps::museum_command
