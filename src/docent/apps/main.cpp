#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <string>
#include <vector>

#include "docent/apps/attract/attract_command.h"
#include "docent/apps/config/config_command.h"
#include "docent/apps/crowd/crowd_command.h"
#include "docent/apps/gateway/gateway_command.h"
#include "docent/apps/golog/golog_command.h"
#include "docent/apps/learn/learn_command.h"
#include "docent/apps/localize/localize_command.h"
#include "docent/apps/localize/map_command.h"
#include "docent/apps/museum/check_command.h"
#include "docent/apps/museum/museum_command.h"
#include "docent/apps/museum/office_command.h"
#include "docent/apps/museum/score_map_command.h"
#include "docent/apps/museum/survey_command.h"
#include "docent/apps/plan/plan_command.h"
#include "docent/apps/replay/evaluate_command.h"
#include "docent/apps/replay/replay_command.h"
#include "docent/apps/rooms/rooms_command.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/simulate/explore_command.h"
#include "docent/apps/simulate/simulate_command.h"
#include "docent/apps/train_sonar/train_sonar_command.h"
#include "docent/apps/up/run_command.h"
#include "docent/apps/up/setup_command.h"
#include "docent/apps/up/up_command.h"
#include "docent/apps/web_account/web_account_command.h"
#include "docent/base/suggestion.h"

namespace {

/// Under the headings of `docent --help`, in its order: by what somebody wants.
void add_commands(CLI::App& app) {
  using namespace docent::apps;
  const auto add = [&app](const char* heading, std::initializer_list<void (*)(CLI::App&)> commands) {
    const std::size_t before = app.get_subcommands({}).size();
    for (const auto command : commands) command(app);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group(heading);
  };
  add("Drive through a museum",
      {simulate_command::add_simulate_command, simulate_command::add_explore_command, up_command::add_up_command,
       web_account_command::add_web_account_command, gateway_command::add_gateway_command});
  add("Make a museum",
      {up_command::add_setup_command, museum_command::add_museum_command, museum_command::add_office_command,
       museum_command::add_survey_command, museum_command::add_check_command, rooms_command::add_rooms_command,
       golog_command::add_golog_command});
  add("Look at recordings",
      {localize_command::add_localize_command, localize_command::add_map_command, museum_command::add_score_map_command,
       replay_command::add_replay_command, replay_command::add_evaluate_command});
  add("Learn and tune", {config_command::add_config_command, learn_command::add_learn_command,
                         train_sonar_command::add_train_sonar_command, attract_command::add_attract_command,
                         crowd_command::add_crowd_command, plan_command::add_plan_command});
  add("Put it into a robot of your own", {up_command::add_run_command});
}

/// The commands by name, for a misspelt one.
std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Docent: an autonomous museum tour guide.", "docent"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "docent " DOCENT_VERSION);
  add_commands(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const auto commands =
        argc > 1 ? app.get_subcommands([&](const CLI::App* command) { return command->get_name() == argv[1]; })
                 : std::vector<CLI::App*>{};
    if (argc > 1 && argv[1][0] != '-' && commands.empty()) {
      const std::string meant = docent::did_you_mean(argv[1], names_of_commands(app));
      std::fprintf(stderr, "docent: unknown command '%s'%s (try --help)\n", argv[1], meant.c_str());
      return 2;
    }
    std::fprintf(stderr, "docent: %s (try --help)\n", error.what());
    return 2;
  } catch (const docent::apps::CommandFailed& failure) {
    if (!failure.message.empty()) std::fprintf(stderr, "docent: %s\n", failure.message.c_str());
    return failure.exit_code;
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "docent: %s\n", exception.what());
    return 1;
  }
}
