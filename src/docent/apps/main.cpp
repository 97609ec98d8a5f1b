#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "docent/apps/attract/attract_command.h"
#include "docent/apps/config/config_command.h"
#include "docent/apps/crowd/crowd_command.h"
#include "docent/apps/golog/golog_command.h"
#include "docent/apps/learn/learn_command.h"
#include "docent/apps/localize/localize_command.h"
#include "docent/apps/localize/map_command.h"
#include "docent/apps/museum/check_command.h"
#include "docent/apps/museum/museum_command.h"
#include "docent/apps/museum/office_command.h"
#include "docent/apps/museum/survey_command.h"
#include "docent/apps/plan/plan_command.h"
#include "docent/apps/replay/evaluate_command.h"
#include "docent/apps/replay/replay_command.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/simulate/simulate_command.h"
#include "docent/apps/up/run_command.h"
#include "docent/apps/up/up_command.h"

int main(int argc, char** argv) {
  CLI::App app{"Docent: an autonomous museum tour guide.", "docent"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "docent " DOCENT_VERSION);
  docent::apps::add_attract_command(app);
  docent::apps::add_check_command(app);
  docent::apps::add_config_command(app);
  docent::apps::add_crowd_command(app);
  docent::apps::add_evaluate_command(app);
  docent::apps::add_golog_command(app);
  docent::apps::add_learn_command(app);
  docent::apps::add_localize_command(app);
  docent::apps::add_map_command(app);
  docent::apps::add_museum_command(app);
  docent::apps::add_office_command(app);
  docent::apps::add_plan_command(app);
  docent::apps::add_replay_command(app);
  docent::apps::add_run_command(app);
  docent::apps::add_simulate_command(app);
  docent::apps::add_survey_command(app);
  docent::apps::add_up_command(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const auto commands =
        argc > 1 ? app.get_subcommands([&](const CLI::App* command) { return command->get_name() == argv[1]; })
                 : std::vector<CLI::App*>{};
    if (argc > 1 && argv[1][0] != '-' && commands.empty()) {
      std::fprintf(stderr, "docent: unknown command '%s' (try --help)\n", argv[1]);
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
