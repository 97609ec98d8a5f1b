#pragma once

namespace CLI {
class App;
}

namespace docent::apps::gateway_command {

/// docent gateway --from HOST:PORT --key FILE
void add_gateway_command(CLI::App& app);

}  // namespace docent::apps::gateway_command
