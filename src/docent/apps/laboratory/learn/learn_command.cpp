#include "docent/apps/laboratory/learn/learn_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "docent/apps/laboratory/learn/learn_picture.h"
#include "docent/apps/laboratory/learn/learn_recording.h"
#include "docent/apps/laboratory/learn/learn_report.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/cache_folder.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log_defaults.h"
#include "docent/apps/shared/map_note.h"
#include "docent/base/files.h"
#include "docent/museum/museum.h"
#include "docent/recording/laser_log.h"
#include "docent/robot/robot_config.h"

namespace docent::apps::learn_command {
namespace {

struct Options {
  std::string map;
  std::string museum;
  std::vector<std::string> logs;
  recording::WantedTopics topics;
  std::string times = "stamps";
  std::string sensor = "laser";
  std::string expected = "cell";
  std::string wall_depth = "auto";
  std::string out;
  std::string pictures;
  std::string picture_format = "png";
  std::string report;
  std::vector<std::string> settings;
  int iterations = 6;
  std::uint64_t seed = 1;
  std::string cache;
};

OccupancyGrid load(const Options& options) {
  if (options.map.empty() == options.museum.empty()) throw CommandFailed{"either --map or --museum is required", 2};
  if (!options.map.empty()) return load_and_say(options.map);
  return load_museum_and_say(options.museum).map;
}

localization::LocalizerParams start_params(const Options& options, const OccupancyGrid& map, double max_range) {
  robot::RobotConfig config;
  if (options.map.empty()) {  // a robot of ours, in a map that was surveyed
    const double reach = reach_of_log(max_range);
    value_or_fail(config.set("localize.sensor={max_range: " + std::to_string(reach) + "}"));
  } else {
    value_or_fail(set_log_defaults(config, map, max_range));
  }
  for (const std::string& setting : options.settings) value_or_fail(config.set("localize." + setting), 2);
  return value_or_fail(config.section<localization::LocalizerParams>("localize"), 2);
}

std::vector<double> wall_depths(const Options& options) {
  if (options.wall_depth != "auto") return {parse_number("--wall-depth", options.wall_depth, "auto or a number [m]")};
  if (options.map.empty()) return {0.0};
  return {0.0, 0.2, 0.4};
}

std::vector<recording::LaserLog> read_logs(const Options& options) {
  const bool sonar = options.sensor == "sonar";
  const recording::LaserLogOptions reading{
      .with_sonars = sonar, .topics = options.topics, .times = times_of(options.times)};
  std::vector<recording::LaserLog> logs;
  for (const std::string& name : options.logs) {
    logs.push_back(value_or_fail(recording::read_laser_log(name, reading)));
    for (const std::string& note : logs.back().notes) std::fprintf(stderr, "%s: %s\n", name.c_str(), note.c_str());
    if (sonar && logs.back().pings.empty()) throw CommandFailed{name + ": holds no readings of sonars with a place"};
    if (sonar && logs.back().sonar_max_range != logs.front().sonar_max_range)
      throw CommandFailed{name + ": its sonars have another range than those of " + options.logs.front()};
  }
  return logs;
}

void write_results(const Options& options, const LearningOutcome& outcome) {
  std::printf("%s\n", learning_table(outcome).c_str());
  const std::string yaml = learned_yaml(outcome);
  if (options.out.empty()) {
    std::printf("%s\n", yaml.c_str());
  } else {
    value_or_fail(write_file_atomically(options.out, yaml));
    std::printf("robot.yaml %s\n", options.out.c_str());
  }
  if (outcome.sensor == "laser") std::printf("docent localize takes them as %s\n", learned_settings(outcome).c_str());
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, learning_json(outcome)));
  if (options.pictures.empty()) return;
  const std::filesystem::path folder = options.pictures;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw CommandFailed{"--pictures " + options.pictures + ": " + error.message()};
  const localization::LearnedModels& learned = outcome.learned;
  const std::string extension = "-model." + options.picture_format;
  value_or_fail(draw_sensor_model(learned.readings, outcome.before, learned.sensor, outcome.sensor)
                    .save(folder / (outcome.sensor + extension)));
  if (learned.motion)
    value_or_fail(draw_motion_model(outcome.motion_before, learned.motion->noise.motion, options.seed)
                      .save(folder / ("motion" + extension)));
}

void learn(const Options& options) {
  const OccupancyGrid map = load(options);
  const std::vector<recording::LaserLog> logs = read_logs(options);
  double max_range = 0.0;
  for (const recording::LaserLog& log : logs) max_range = std::max(max_range, log.max_range);
  const localization::LocalizerParams start = start_params(options, map, max_range);
  if (localization::StateSpace{map, sensor_models::RayCaster{map}, start.states}.places() == 0)
    throw CommandFailed{options.map + options.museum + ": no free place in this map"};
  std::vector<localization::LearningRecording> recordings;
  for (const recording::LaserLog& log : logs)
    recordings.push_back(learning_recording(log, start.sensor.max_range, options.sensor == "sonar"));

  localization::BootstrapParams params;
  params.most_iterations = options.iterations;
  params.wall_depths = wall_depths(options);
  params.expected_at = options.expected == "pose" ? localization::ExpectedAt::pose : localization::ExpectedAt::cell;
  params.seed = options.seed;
  prepare_cache(options.cache);
  params.cache.folder = options.cache;
  if (options.sensor == "sonar") {
    params.sonar.emplace();
    params.sonar->max_range = logs.front().sonar_max_range;
  }
  for (const double depth : params.wall_depths) {
    localization::LocalizerParams with = start;
    with.states.wall_depth = depth;
    value_or_fail(with.validate(), 2);
  }
  auto learned = value_or_fail(localization::bootstrap(
      recordings, map, start, params, [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }));
  write_results(options, {options.sensor, options.logs, options.map + options.museum,
                          params.sonar ? *params.sonar : start.sensor, start.motion, std::move(learned)});
}

}  // namespace

void add_learn_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("learn-sensor-model", "Learn from recordings how a sensor and the wheels err");
  command->add_option("--map", options->map, "map_server YAML file");
  command->add_option("--museum", options->museum, "museum folder, instead of a map");
  command
      ->add_option("--log", options->logs,
                   "CARMEN text log (plain or .gz), MCAP recording, rosbag2 folder or database; may be repeated")
      ->required();
  add_topic_options(*command, options->topics);
  add_times_option(*command, options->times);
  command->add_option("--sensor", options->sensor, "laser, or sonar (labelled by the laser)")
      ->check(CLI::IsMember({"laser", "sonar"}))
      ->capture_default_str();
  command->add_option("--out", options->out, "robot.yaml to write; without: on the terminal")->check(output_file());
  command->add_option("--pictures", options->pictures, "folder for pictures of both models")->check(output_folder());
  add_picture_format(*command, options->picture_format);
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command
      ->add_option("--expected", options->expected,
                   "where ranges are expected: cell (for the grid, whose cells blur), pose (for particles)")
      ->check(CLI::IsMember({"cell", "pose"}))
      ->capture_default_str();
  command
      ->add_option("--wall-depth", options->wall_depth,
                   "[m] how deep inside the map's walls their surface lies, or auto: what explains the logs best")
      ->capture_default_str();
  command->add_option("--iterations", options->iterations, "at most; it ends when the likelihood settles")
      ->check(CLI::Range(1, 50))
      ->capture_default_str();
  command->add_option("--set", options->settings, "key=value of the localizer that begins, e.g. beams=90");
  add_seed(*command, "--seed", options->seed, "seed of the localizer's choice of beams");
  add_cache_options(*command, options->cache);
  command->callback([options] { learn(*options); });
}

}  // namespace docent::apps::learn_command
