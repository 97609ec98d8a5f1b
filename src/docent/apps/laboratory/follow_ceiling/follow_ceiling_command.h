#pragma once

namespace CLI {
class App;
}

namespace docent::apps::follow_ceiling_command {

/// `docent-lab follow-ceiling`: finds and follows a robot by pictures of the ceiling alone, beside the truth.
void add_follow_ceiling_command(CLI::App& app);

}  // namespace docent::apps::follow_ceiling_command
