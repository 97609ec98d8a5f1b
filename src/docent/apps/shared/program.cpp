#include "docent/apps/shared/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/suggestion.h"

namespace docent::apps {

namespace {

void add_commands(const Program& program, CLI::App& app) {
  for (const CommandGroup& group : program.groups) {
    const std::size_t before = app.get_subcommands({}).size();
    for (const auto& command : group.commands) command(app);
    const std::vector<CLI::App*> all = app.get_subcommands({});
    for (std::size_t i = before; i < all.size(); ++i) all[i]->group(group.heading);
  }
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// What is wrong with arguments that CLI11 refused for `reason`.
std::string fault_of(const Program& program, const CLI::App& app, int argc, const char* const* argv,
                     const std::string& reason) {
  const std::string command = argc > 1 ? argv[1] : "";
  const std::vector<std::string> names = names_of(app);
  if (command.empty() || command.front() == '-' || std::find(names.begin(), names.end(), command) != names.end())
    return reason + " (try --help)";
  if (std::find(program.others.begin(), program.others.end(), command) != program.others.end())
    return "'" + command + "' is a command of " + program.other;
  return "unknown command '" + command + "'" + did_you_mean(command, names) + " (try --help)";
}

}  // namespace

std::vector<std::string> names_of_commands(const Program& program) {
  CLI::App app;
  add_commands(program, app);
  return names_of(app);
}

int run(const Program& program, int argc, const char* const* argv) {
  CLI::App app{program.meaning, program.name};
  app.require_subcommand(1);
  app.set_version_flag("--version", program.name + " " + program.version);
  add_commands(program, app);
  app.parse_complete_callback([&app] { refuse_shared_outputs(app); });  // before the command runs
  const char* name = program.name.c_str();
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "%s: %s\n", name, fault_of(program, app, argc, argv, error.what()).c_str());
    return 2;
  } catch (const CommandFailed& failure) {
    if (!failure.message.empty()) std::fprintf(stderr, "%s: %s\n", name, failure.message.c_str());
    return failure.exit_code;
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "%s: %s\n", name, exception.what());
    return 1;
  }
}

}  // namespace docent::apps
