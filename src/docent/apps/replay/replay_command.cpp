#include "docent/apps/replay/replay_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>

#include "docent/apps/replay/replay_run.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/cache_folder.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/map_note.h"
#include "docent/base/files.h"

namespace docent::apps::replay_command {
namespace {

struct ReplayCommandOptions {
  ReplayOptions replay;
  Deployment deployment;
  std::string report;
  std::string start;
  bool check = false;
};

/// --museum, else the one that the recording names, beside the default one.
std::string museum_folder(const ReplayCommandOptions& options) {
  if (!options.deployment.museum.empty()) return options.deployment.museum;
  const std::string name = value_or_fail(museum_of_recording(options.replay.recording));
  const std::filesystem::path known = default_museum();
  if (name.empty()) return known.string();
  const auto folder = known.parent_path() / std::filesystem::path{name}.filename();
  if (!std::filesystem::exists(folder))
    throw CommandFailed{
        options.replay.recording + ": was made in the museum '" + name + "': give its folder by --museum", 2};
  return folder.string();
}

void replay_recording(ReplayCommandOptions& options) {
  options.deployment.museum = museum_folder(options);
  const museum::Museum museum = value_or_fail(options.deployment.load());
  say_map(museum);
  RobotMaker& robot = *options.replay.robot_maker;
  robot::RobotConfig config = value_or_fail(options.deployment.load_config(robot.sections()));
  value_or_fail(robot.read(config));
  const bool shows_progress = isatty(STDERR_FILENO) != 0;
  if (shows_progress) options.replay.progress = [](double share) { std::fprintf(stderr, "\r%3.0f %%", 100.0 * share); };
  options.replay.seed = options.deployment.seed;
  if (!options.start.empty()) options.replay.start = parse_pose("--start", options.start);
  prepare_cache(options.replay.cache);
  const ReplayOutcome outcome = value_or_fail(replay(museum, config, options.replay));
  if (shows_progress) std::fputc('\n', stderr);

  const auto list = [](const char* title, const std::vector<std::string>& names) {
    std::printf("%s", title);
    for (const std::string& name : names) std::printf(" %s", name.c_str());
    std::printf("\n");
  };
  std::printf("%.0f s replayed\n", outcome.seconds);
  list("modules        ", outcome.modules);
  list("from recording ", outcome.replayed_topics);
  const std::string difference = first_difference(outcome.recorded, outcome.repeated, outcome.seconds);
  for (const ReplayEvent& event : outcome.repeated)
    std::printf("%9.1f s  %-20s %s\n", event.at_s, event.kind.c_str(), event.subject.c_str());
  const auto of_mission = [](const std::vector<ReplayEvent>& events) {
    return std::count_if(events.begin(), events.end(), [](const ReplayEvent& event) { return event.is_of_mission(); });
  };
  if (!outcome.recorded.empty() || !outcome.repeated.empty())
    std::printf("events of the mission: %td recorded, %td now; %s\nevents under way: %td recorded, %td now\n",
                of_mission(outcome.recorded), of_mission(outcome.repeated),
                difference.empty() ? "the same in the same order" : difference.c_str(),
                std::ssize(outcome.recorded) - of_mission(outcome.recorded),
                std::ssize(outcome.repeated) - of_mission(outcome.repeated));
  if (outcome.report) {
    std::fputs(evaluation::summary_table(*outcome.report, std::nullopt).c_str(), stdout);
    if (!options.report.empty())
      value_or_fail(write_file_atomically(options.report, evaluation::to_json(*outcome.report, std::nullopt)));
  } else if (!options.report.empty()) {
    throw CommandFailed{options.replay.recording + ": holds no ground truth (/truth/state)"};
  }
  if (options.check && !difference.empty()) throw CommandFailed{"the mission events differ: " + difference};
}

}  // namespace

void add_replay_command(CLI::App& app, std::shared_ptr<RobotMaker> robot) {
  auto options = std::make_shared<ReplayCommandOptions>();
  options->replay.robot_maker = std::move(robot);
  CLI::App* command = app.add_subcommand("replay", "Run modules again on what a recording's sensors saw");
  command->add_option("recording", options->replay.recording, "MCAP file")->required();
  command->add_option("--modules", options->replay.modules, "Which, separated by commas; without it all but sound")
      ->delimiter(',');
  command->add_option("--museum", options->deployment.museum, "Folder of the museum; without it the recording's");
  command->add_option("--robot", options->deployment.robot, "robot.yaml of the robot; without it all defaults");
  command->add_option("--set", options->deployment.settings, "section.key=value, over robot.yaml; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--start", options->start, "X,Y,DEG: where localize is told that the robot stands at the start")
      ->check(pose_option());
  add_seed(*command, "--seed", options->deployment.seed, "Seed of everything random");
  add_cache_options(*command, options->replay.cache);
  command->add_option("--out", options->replay.out, "MCAP file to write: what happened this time")
      ->check(output_file());
  command->add_option("--report", options->report, "JSON file to write: the deployment report of this time")
      ->check(output_file());
  command->add_option("--claims", options->replay.claims, "CSV file to write: every belief beside the truth")
      ->check(output_file());
  command->add_flag("--check", options->check,
                    "Fail where the mission events are not those of the recording, in the same order; how it went "
                    "under way is not compared");
  command->callback([options] { replay_recording(*options); });
}

}  // namespace docent::apps::replay_command
