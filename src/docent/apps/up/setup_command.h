#pragma once

namespace CLI {
class App;
}

namespace docent::apps::up_command {

/// `docent setup FOLDER`: from an empty folder to a museum's first tour, in the browser.
void add_setup_command(CLI::App& app);

}  // namespace docent::apps::up_command
