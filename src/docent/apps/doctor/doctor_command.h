#pragma once

namespace CLI {
class App;
}

namespace docent::apps::doctor_command {

/// `docent doctor`: whether all arrives, before a motor turns. Exits with 1 where something is wrong.
void add_doctor_command(CLI::App& app);

}  // namespace docent::apps::doctor_command
