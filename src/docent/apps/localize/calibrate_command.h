#pragma once

namespace CLI {
class App;
}

namespace docent::apps::localize_command {

/// `docent calibrate`: where the scanners of a recording are mounted, and how late they are.
void add_calibrate_command(CLI::App& app);

}  // namespace docent::apps::localize_command
