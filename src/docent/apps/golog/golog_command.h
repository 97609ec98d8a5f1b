#pragma once

namespace CLI {
class App;
}

namespace docent::apps::golog_command {

/// `docent golog check|plan|trace MUSEUM`
void add_golog_command(CLI::App& app);

}  // namespace docent::apps::golog_command
