#pragma once

namespace CLI {
class App;
}

namespace docent::apps {

/// `docent localize --map MAP.yaml --log LOG`
void add_localize_command(CLI::App& app);

}  // namespace docent::apps
