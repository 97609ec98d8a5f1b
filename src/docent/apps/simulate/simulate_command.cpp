#include "docent/apps/simulate/simulate_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/cache_folder.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/log.h"
#include "docent/apps/shared/map_note.h"
#include "docent/apps/simulate/simulation_run.h"
#include "docent/base/files.h"
#include "docent/museum/museum.h"

namespace docent::apps::simulate_command {
namespace {

struct Options {
  SimulationRunOptions run;
  double hours = 0.5;
  std::string start;
  std::string time_of_day = "10:00";
  std::string report;
  std::string picture;
  double pace = 0.0;
  int port = 0;
  bool quiet = false;
};

void print_profile(const SimulationRun& run) {
  std::vector<std::pair<std::string, double>> rows;
  for (const auto& [name, cost] : run.seconds_by_module()) {
    rows.emplace_back(name, cost);
  }
  const evaluation::RunCost whole = run.cost();
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  const double virtual_s = to_seconds(run.now());
  std::printf("%-26s %10s %8s\n", "module", "ms a v.s.", "share");
  for (const auto& [name, cost] : rows) {
    std::printf("%-26s %10.3f %7.1f%%\n", name.c_str(), 1e3 * cost / virtual_s, 100.0 * cost / whole.cpu_seconds);
  }
  std::printf("%-26s %10.3f\n", "everything", 1e3 * whole.cpu_seconds / virtual_s);
  std::printf("virtual time runs %.1f times faster than real time by the processor's time, %.1f times by the wall's\n",
              virtual_s / whole.cpu_seconds, virtual_s / whole.wall_seconds);
}

/// CSV files of single runs.
void add_logs(CLI::App& command, SimulationRunOptions& run) {
  command.add_option("--claims", run.claims, "CSV file to write: every belief beside the truth")->check(output_file());
  command
      .add_option("--health-log", run.health_log,
                  "CSV file to write: what the modules said of themselves, a row a change")
      ->check(output_file());
  command
      .add_option("--drive-log", run.drive_log,
                  "CSV file to write: how the robot drives beside what collision avoidance says")
      ->check(output_file());
  command
      .add_option("--event-log", run.event_log,
                  "CSV file to write: events, reactions to blocked ways, lines said and touches, with times and places")
      ->check(output_file());
  command
      .add_option("--request-log", run.request_log,
                  "CSV file to write: requests, what became of them, explanations and orders of visits, with places")
      ->check(output_file());
  command
      .add_option("--travel-times", run.travel_times,
                  "CSV file to write: how long the ways between places took, as the robot has learned it")
      ->check(output_file());
  command
      .add_option("--thing-log", run.thing_log,
                  "CSV file to write: when the stools of a scenario were seen, and when the live map had them")
      ->check(output_file());
  command
      .add_option("--office-log", run.office_log,
                  "CSV file to write: how deliveries and tidying up go, and the things that were seen")
      ->check(output_file());
  command.add_option("--people-log", run.people_log, "CSV file to write: tracked people beside the true ones")
      ->check(output_file());
}

void simulate(Options& options) {
  if (!(options.hours > 0.0 && options.hours <= 10000.0)) throw CommandFailed{"--hours must be in (0, 10000]", 2};
  if (!options.start.empty()) options.run.start = parse_pose("--start", options.start);
  const auto rest_of_day = museum::parse_hours(options.time_of_day + "-24:00");
  if (!rest_of_day) throw CommandFailed{"--time-of-day " + options.time_of_day + ": expected HH:MM", 2};
  options.run.day_begins = std::chrono::minutes{rest_of_day->from_minute};
  if (options.pace < 0.0) throw CommandFailed{"--pace must be >= 0", 2};
  options.run.hosts_web = options.port != 0;
  if (options.run.hosts_web) {
    options.run.settings.push_back("web.port=" + std::to_string(options.port));
    if (options.pace == 0.0) options.pace = 1.0;
  }
  prepare_cache(options.run.cache);
  if (!options.quiet && !options.run.explore) load_museum_and_say(options.run.museum);
  const auto run = value_or_fail(SimulationRun::create(options.run));
  const Time end = time_from_seconds(options.hours * 3600.0);
  const auto wall_start = std::chrono::steady_clock::now();
  const auto wall_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
  };
  Progress progress{::isatty(STDERR_FILENO) != 0};
  // Steps of a tenth of a second when paced, so that the page is smooth.
  const Duration step = options.pace > 0.0 ? seconds(0.1) : seconds(10.0);
  while (run->now() < end) {
    value_or_fail(run->run_until(std::min(run->now() + step, end)));
    if (options.pace > 0.0) {
      const double ahead = to_seconds(run->now()) / options.pace - wall_s();
      if (ahead > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(ahead));
    }
    const double done = to_seconds(run->now()) / to_seconds(end);
    if (options.quiet || !progress.is_due(done, wall_s())) continue;
    char line[200];
    std::snprintf(line, sizeof line, "%3.0f %% of %.2f h, %.1f x real time. %s", 100.0 * done, options.hours,
                  to_seconds(run->now()) / wall_s(), run->status().c_str());
    std::fputs(progress.shown(line).c_str(), stderr);
  }
  if (!options.quiet) std::fputs(progress.end().c_str(), stderr);
  value_or_fail(run->finish());
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, run->report_json() + "\n"));
  if (!options.picture.empty()) value_or_fail(run->save_picture(options.picture));
  if (!options.quiet) std::printf("%s", run->summary().c_str());
  if (options.run.profile) print_profile(*run);
}

}  // namespace

void add_simulate_command(CLI::App& app, std::shared_ptr<RobotMaker> robot) {
  auto options = std::make_shared<Options>();
  options->run.robot_maker = std::move(robot);
  options->run.museum = default_museum();
  CLI::App* command =
      app.add_subcommand("simulate", "Run the whole robot in a simulated museum, faster than real time");
  command->add_option("--museum", options->run.museum, "museum folder")->capture_default_str();
  command->add_option("--robot", options->run.robot, "robot.yaml; without: all defaults");
  command->add_option("--hours", options->hours, "virtual hours")->capture_default_str();
  add_seed(*command, "--seed", options->run.seed, "same seed, same run");
  command->add_option("--crowd", options->run.crowd, "persons: empty, quiet, busy, packed")
      ->check(CLI::IsMember({"empty", "quiet", "busy", "packed"}))
      ->capture_default_str();
  command->add_option("--people", options->run.people, "so many persons instead of the crowd's density")
      ->check(CLI::Range(0, 10000));
  options->run.bodies = "legs";  // what a robot meets in a hall; a run that a test makes has discs
  command->add_option("--bodies", options->run.bodies, "what people are made of: legs that walk, or discs to the floor")
      ->check(CLI::IsMember({"legs", "discs"}))
      ->capture_default_str();
  command
      ->add_option("--heedless", options->run.heedless,
                   "share of people who do not evade: children who run, backs turned, a phone in hand")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--requests-per-hour", options->run.requests_per_hour, "wishes of simulated visitors");
  command->add_option("--scenario", options->run.scenario, "YAML file of timed events");
  command->add_option("--start", options->start, "X,Y,DEG in the map; without: anywhere, and the robot is not told")
      ->check(pose_option());
  command->add_option("--mode", options->run.mode, "open, web, closed, or hours: what the museum's hours say")
      ->capture_default_str();
  command->add_option("--time-of-day", options->time_of_day, "HH:MM at which the run begins")->capture_default_str();
  command->add_option("--max-speed", options->run.max_speed, "[m/s] instead of the mode's speed limit")
      ->check(CLI::Range(0.01, 10.0));
  command->add_option("--set", options->run.settings, "section.key=value over robot.yaml; may be repeated");
  command->add_option("--state", options->run.state, "folder of checkpoints and databases; without: a temporary one")
      ->check(kept_folder());
  add_cache_options(*command, options->run.cache);
  command->add_flag("!--world-only", options->run.has_robot,
                    "no module of the robot runs: for recordings of sensors, with a scenario that steers");
  command->add_option("--report", options->report, "JSON file for the deployment report")->check(output_file());
  add_logs(*command, options->run);
  command->add_option("--record", options->run.recording, "MCAP file of all messages and the truth")
      ->check(output_file());
  command->add_option("--picture", options->picture, "the way driven over the map")->check(output_picture());
  command
      ->add_option("--camera-pictures", options->run.camera_pictures,
                   "folder for robot.jpg and scene.jpg, which both cameras saw last; without, and without a page, no "
                   "camera is simulated")
      ->check(output_folder());
  command->add_option("--pace", options->pace, "virtual seconds a second; 0: as fast as possible")
      ->capture_default_str();
  command->add_option("--port", options->port, "also serve the page at this port (pace 1 unless given)");
  command->add_flag("--profile", options->run.profile, "print where the processor's time went");
  command->add_flag("--quiet", options->quiet, "no progress and no summary");
  command->callback([options] { simulate(*options); });
}

}  // namespace docent::apps::simulate_command
