#include "docent/apps/localize_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/arguments.h"
#include "docent/apps/command.h"
#include "docent/apps/localize_log.h"
#include "docent/apps/localize_picture.h"
#include "docent/apps/log_defaults.h"
#include "docent/base/files.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/monte_carlo/monte_carlo_localizer.h"
#include "docent/recording/laser_log.h"
#include "docent/robot/robot_config.h"

namespace docent {
namespace {

struct Options {
  std::string map;
  std::string log;
  std::string method = "grid";
  std::string filter = "distance";
  std::string start = "unknown";
  bool reverse = false;
  bool both_ways = false;
  std::string compare;
  std::string poses;
  std::string report;
  std::string picture;
  std::string wall_depth = "auto";
  std::vector<std::string> settings;
  std::uint64_t seed = 1;
};

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(q * static_cast<double>(values.size())))];
}

/// Runs the log once; draws into `pictures` when it is not empty.
LogRun run_once(const Options& options, const LaserLog& log, const OccupancyGrid& map, Localizer& localizer,
                bool reverse, const std::filesystem::path& pictures) {
  LogRunOptions run_options;
  run_options.reverse = reverse;
  // The other direction begins where nobody said.
  if (options.start != "unknown" && reverse == options.reverse)
    run_options.start = parse_pose("--start", options.start);
  std::optional<BeliefMovie> movie;
  if (!pictures.empty()) movie.emplace(value_or_fail(BeliefMovie::create(map)));
  std::size_t seen = 0;
  const bool has_two = has_two_lasers(log);
  run_options.watch = [&](const Localizer& at, std::size_t scan, const Localizer::Step& step) {
    if (++seen % 500 == 0) std::fprintf(stderr, "%zu of %zu scans\n", seen, log.scans.size());
    if (movie && step.updated && !movie->is_full())
      value_or_fail(movie->add(at, log.scans[scan], log.max_range, has_two));
  };
  LogRun run = localize_log(log, localizer, run_options);
  if (!pictures.empty()) {
    std::filesystem::create_directories(pictures);
    const std::string suffix = reverse ? "-reversed" : "";
    value_or_fail(movie->save(pictures / ("belief" + suffix + ".webp")));
    const std::size_t stride = std::max<std::size_t>(1, log.scans.size() / 25);
    value_or_fail(save_png(draw_run(map, log, run, stride), pictures / ("scans" + suffix + ".png")));
    for (std::size_t n = 1; n <= 12; ++n) {
      const std::size_t i = n * log.scans.size() / 13;
      if (!run.poses[i].has_pose) continue;
      char name[40];
      std::snprintf(name, sizeof name, "scan-%05zu%s.png", i, suffix.c_str());
      value_or_fail(save_png(draw_scan(map, log.scans[i], log.max_range, run.poses[i]), pictures / name));
    }
  }
  return run;
}

nlohmann::json report_of(const LaserLog& log, const LogRun& run, const RayCaster& caster) {
  const double updates = static_cast<double>(std::max<std::size_t>(run.updates, 1));
  nlohmann::json report;
  report["scans"] = log.scans.size();
  report["updates"] = run.updates;
  report["seconds_per_scan"] = {
      {"first", run.seconds_first}, {"median", quantile(run.seconds, 0.5)}, {"p99", quantile(run.seconds, 0.99)}};
  report["localized_after_scans"] = run.localized_after ? nlohmann::json(*run.localized_after) : nlohmann::json();
  report["beams_used"] = static_cast<double>(run.beams_used) / updates;
  report["beams_filtered"] = static_cast<double>(run.beams_filtered) / updates;
  report["fit"] = run.fit;
  report["endpoints_near_walls"] = endpoints_near_walls(log, run, caster, 0.2);
  const auto localized =
      std::count_if(run.poses.begin(), run.poses.end(), [](const auto& pose) { return pose.localized; });
  report["localized_fraction"] = static_cast<double>(localized) / static_cast<double>(run.poses.size());
  return report;
}

nlohmann::json to_json(const RunAgreement& agreement) {
  return {{"scans", agreement.scans},
          {"both_know", agreement.both_know},
          {"within_half_a_metre_and_10_degrees", agreement.share},
          {"median_m", agreement.median_m},
          {"p95_m", agreement.p95_m},
          {"max_m", agreement.max_m}};
}

void print(const char* title, const nlohmann::json& report) {
  std::printf("%s\n", title);
  for (const auto& [key, value] : report.items()) std::printf("  %-24s %s\n", key.c_str(), value.dump().c_str());
}

/// What both methods need, and the particles' own.
struct MethodParams {
  MarkovLocalizerParams grid;
  MonteCarloParams particles;
  template <class V>
  void visit(V& v) {
    grid.visit(v);
    v("particles", particles);
  }
  [[nodiscard]] Result<void> validate() const {
    if (auto valid = particles.validate(); !valid) return valid;
    return grid.validate();
  }
};

std::unique_ptr<Localizer> make_localizer(const Options& options, const OccupancyGrid& map,
                                          const MethodParams& params) {
  if (options.method == "particles")
    return std::make_unique<MonteCarloLocalizer>(map, params.grid, params.particles, "", options.seed);
  return std::make_unique<MarkovLocalizer>(map, params.grid, "", options.seed);
}

MethodParams params_for(const Options& options, const OccupancyGrid& map, const LaserLog& log) {
  RobotConfig config;
  value_or_fail(set_log_defaults(config, map, log.max_range));
  value_or_fail(config.set("localize.particles={most: 300000, reserve: 30000, draw_every: 1}"));  // there is time
  for (const std::string& setting : options.settings) {
    for (const std::string own : {"filter", "states"})
      if (setting.rfind(own + "=", 0) == 0 && (own == "filter" || setting.find("wall_depth") != std::string::npos))
        throw CommandFailed{"--set " + setting + ": use " + (own == "filter" ? "--filter" : "--wall-depth"), 2};
    value_or_fail(config.set("localize." + setting), 2);
  }
  auto params = value_or_fail(config.section<MethodParams>("localize"), 2);
  params.grid.filter = options.filter;
  return params;
}

/// Maps made from scans have walls as thick as the scans were uncertain, and the true surface lies inside. The depth
/// at which the map explains the log best, over a run from its beginning and one from its end. The walls are the same
/// for every method, and the grid is the fastest from an unknown start.
double find_wall_depth(const Options& options, const LaserLog& log, const OccupancyGrid& map, MethodParams params) {
  double best_depth = 0.0;
  double best_fit = 0.0;
  for (const double depth : {0.0, 0.2, 0.4}) {  // nearer ones differ less than two runs do
    params.grid.states.wall_depth = depth;
    MarkovLocalizer localizer{map, params.grid, "", options.seed};
    double fit = 0.0;
    for (const bool reverse : {false, true}) {
      localizer.start_unknown();
      fit += 0.5 * run_once(options, log, map, localizer, reverse, {}).fit;
    }
    std::fprintf(stderr, "walls %.1f m deep: mean ln P of a beam %.3f\n", depth, fit);
    if (depth > 0.0 && fit <= best_fit) continue;
    best_depth = depth;
    best_fit = fit;
  }
  return best_depth;
}

void localize(const Options& options) {
  const OccupancyGrid map = value_or_fail(load_map(options.map));
  const LaserLog log = value_or_fail(read_laser_log(options.log));
  MethodParams params = params_for(options, map, log);
  if (StateSpace{map, RayCaster{map}, params.grid.states}.places() == 0)
    throw CommandFailed{options.map + ": no free place in this map"};
  if (options.wall_depth == "auto") {
    params.grid.states.wall_depth = find_wall_depth(options, log, map, params);
  } else {
    params.grid.states.wall_depth = parse_numbers("--wall-depth", options.wall_depth, 1).front();
    value_or_fail(params.validate(), 2);
  }
  const auto localizer = make_localizer(options, map, params);

  const LogRun run = run_once(options, log, map, *localizer, options.reverse, options.picture);
  const RayCaster caster{map};
  nlohmann::json report = report_of(log, run, caster);
  report["map"] = options.map;
  report["log"] = options.log;
  report["method"] = options.method;
  report["filter"] = options.filter;
  report["start"] = options.start;
  report["reversed"] = options.reverse;
  report["wall_depth"] = params.grid.states.wall_depth;
  print(options.reverse ? "reversed" : "forward", report);
  if (options.both_ways) {
    localizer->start_unknown();
    const LogRun other = run_once(options, log, map, *localizer, !options.reverse, options.picture);
    report["other_way"] = report_of(log, other, caster);
    report["agreement"] = to_json(agreement_of(run.poses, other.poses));
    print("the other way", report["other_way"]);
    print("agreement", report["agreement"]);
  }
  if (!options.compare.empty()) {
    const auto others = value_or_fail(load_poses(options.compare));
    if (others.size() != run.poses.size()) throw CommandFailed{options.compare + ": poses of another log"};
    report["agreement"] = to_json(agreement_of(run.poses, others));
    print("agreement", report["agreement"]);
  }
  if (!options.poses.empty()) value_or_fail(save_poses(run.poses, options.poses));
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
}

}  // namespace

void add_localize_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("localize", "Localize a recorded log in a map");
  command->add_option("--map", options->map, "map_server YAML file")->required();
  command
      ->add_option("--log", options->log, "CARMEN text log (plain or .gz), MCAP recording, rosbag2 folder or database")
      ->required();
  command->add_option("--method", options->method, "grid, particles")
      ->check(CLI::IsMember({"grid", "particles"}))
      ->capture_default_str();
  command->add_option("--filter", options->filter, "none, entropy, distance, novelty")
      ->check(CLI::IsMember({"none", "entropy", "distance", "novelty"}))
      ->capture_default_str();
  command
      ->add_option("--start", options->start,
                   "unknown, or X,Y,DEG of the first scan that is offered (with --reverse the last of the log)")
      ->capture_default_str();
  command->add_flag("--reverse", options->reverse, "from the last scan to the first, with inverse odometry");
  command->add_flag("--both-ways", options->both_ways, "forward and reversed, and how they agree");
  command->add_option("--compare", options->compare, "poses of another run over this log");
  command->add_option("--poses", options->poses, "CSV file to write: the pose of every scan");
  command->add_option("--report", options->report, "JSON file to write");
  command->add_option("--picture", options->picture, "folder for pictures: the belief, the scans in the map");
  command
      ->add_option("--wall-depth", options->wall_depth,
                   "[m] how deep inside the map's walls their surface lies, or auto: what explains the log best")
      ->capture_default_str();
  command->add_option("--set", options->settings, "key=value of the localizer's parameters, e.g. beams=90");
  command->add_option("--seed", options->seed, "seed of the random choice of beams")->capture_default_str();
  command->callback([options] { localize(*options); });
}

}  // namespace docent
