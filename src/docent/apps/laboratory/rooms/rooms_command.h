#pragma once

namespace CLI {
class App;
}

namespace docent::apps::rooms_command {

/// `docent-lab rooms`: rooms, hallways and doors of a map [Buhmann1995].
void add_rooms_command(CLI::App& app);

}  // namespace docent::apps::rooms_command
