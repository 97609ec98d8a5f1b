#pragma once

namespace CLI {
class App;
}

namespace docent::apps {

/// `docent check MUSEUM_DIR`
void add_check_command(CLI::App& app);

}  // namespace docent::apps
