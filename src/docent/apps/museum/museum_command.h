#pragma once

namespace CLI {
class App;
}

namespace docent::apps::museum_command {

/// `docent museum`: a museum folder from a map, with recorded people in its halls.
void add_museum_command(CLI::App& app);

}  // namespace docent::apps::museum_command
