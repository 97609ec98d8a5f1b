#include "docent/apps/up/up_command.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/up/robot_run.h"

namespace docent::apps::up_command {

void add_up_command(CLI::App& app) {
  auto options = std::make_shared<RobotRun>();
  CLI::App* command = app.add_subcommand("up", "Run the robot: every module as a process, watched and restarted");
  options->deployment.add_options(*command);
  command->add_flag("--sim", options->simulate, "Simulate the museum, its visitors and the robot's body");
  command->add_option("--port", options->port, "Port of the page")->check(CLI::Range(1, 65535))->capture_default_str();
  command
      ->add_option("--record", options->record,
                   "MCAP file that gets what the record module records in --state from the start to the end")
      ->check(output_file());
  options->simulator.add_options(*command->add_option_group("With --sim"));
  command->callback([options, command] {
    for (const std::string option : {"--crowd", "--start", "--world", "--scenario", "--requests-per-hour"})
      if (!options->simulate && command->count(option) > 0)
        throw CommandFailed{option + " is of a simulated museum: it needs --sim", 2};
    // A real museum keeps its hours; a simulated one is open whenever somebody looks.
    if (!options->simulate && command->count("--mode") == 0) options->simulator.mode = "hours";
    run_robot(*options);
  });
}

}  // namespace docent::apps::up_command
