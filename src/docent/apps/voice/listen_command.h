#pragma once

namespace CLI {
class App;
}

namespace docent::apps::listen_command {

/// `docent listen`: what the robot would understand of recordings of commands ([Buhmann1995] 4).
void add_listen_command(CLI::App& app);

}  // namespace docent::apps::listen_command
