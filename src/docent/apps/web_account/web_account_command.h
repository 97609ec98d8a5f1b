#pragma once

#include <string>

namespace CLI {
class App;
}

namespace docent::apps::web_account_command {

/// docent web-account add|passwd|remove|list
void add_web_account_command(CLI::App& app);

/// The first line of the standard input, asked for by `prompt` and not shown where that is a terminal.
[[nodiscard]] std::string read_secret(const std::string& prompt);

}  // namespace docent::apps::web_account_command
