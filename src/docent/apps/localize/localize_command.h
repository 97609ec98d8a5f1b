#pragma once

namespace CLI {
class App;
}

namespace docent::apps::localize_command {

/// `docent localize --map MAP.yaml --log LOG`
void add_localize_command(CLI::App& app);

}  // namespace docent::apps::localize_command
