#include "docent/apps/localize/localize_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "docent/apps/localize/localize_log.h"
#include "docent/apps/localize/localize_picture.h"
#include "docent/apps/localize/localize_summary.h"
#include "docent/apps/localize/log_reference.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/cache_folder.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log_defaults.h"
#include "docent/apps/shared/map_note.h"
#include "docent/base/files.h"
#include "docent/evaluation/reference/reference_score.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/monte_carlo/monte_carlo_localizer.h"
#include "docent/recording/laser_log.h"
#include "docent/robot/robot_config.h"

namespace docent::apps::localize_command {
namespace {

struct Options {
  std::string map;
  LogChoice choice;
  std::string method = "grid";
  std::string filter = "distance";
  std::string start = "unknown";
  std::string odometry = "logged";
  evaluation::OdometryNoiseParams noise;
  std::uint64_t noise_seed = 1;
  bool dead_reckoning = false;
  bool reverse = false;
  bool both_ways = false;
  std::string compare;
  std::string poses;
  std::string report;
  std::string picture;
  std::string picture_format = "png";
  std::string wall_depth = "auto";
  std::vector<std::string> settings;
  std::uint64_t seed = 1;
  std::string cache;
};

/// Runs the log once, and looks back where `hindsight` is given; draws into `pictures` when it is not empty.
/// `purpose`: for people who wait.
LogRun run_once(const Options& options, const ReferencedLog& referenced, const OccupancyGrid& map,
                const std::optional<localization::HindsightParams>& hindsight, localization::Localizer& localizer,
                bool reverse, const std::string& purpose, const std::filesystem::path& pictures) {
  const recording::LaserLog& log = referenced.log;
  LogRunOptions run_options;
  run_options.reverse = reverse;
  run_options.dead_reckoning = options.dead_reckoning;
  if (options.start == "reference") {
    run_options.start = reverse ? referenced.reference.back() : referenced.reference.front();
  } else if (options.start != "unknown" && reverse == options.reverse) {  // the other way begins where nobody said
    run_options.start = parse_pose("--start", options.start);
  }
  std::optional<BeliefMovie> movie;
  if (!pictures.empty()) movie.emplace(map, log);
  std::size_t seen = 0;
  run_options.watch = [&](const localization::Localizer& at, std::size_t scan,
                          const localization::Localizer::Step& step) {
    if (++seen % 500 == 0)
      std::fprintf(stderr, "%s%s: %zu of %zu scans\n", purpose.c_str(), reverse ? ", reversed" : "", seen,
                   log.scans.size());
    if (movie && step.updated && !movie->is_full()) value_or_fail(movie->add(at, scan));
  };
  LogRun run = localize_log(log, localizer, run_options);
  if (hindsight && !options.dead_reckoning) look_back(log, reverse, sensor_models::RayCaster{map}, *hindsight, run);
  if (!pictures.empty()) {
    std::filesystem::create_directories(pictures);
    const std::string suffix = reverse ? "-reversed" : "";
    const std::string extension = suffix + "." + options.picture_format;
    if (run.updates > 0) {
      value_or_fail(movie->save(pictures / ("belief" + suffix + ".webp")));
      value_or_fail(movie->moments().save(pictures / ("moments" + extension)));
    }
    const std::size_t stride = std::max<std::size_t>(1, log.scans.size() / 25);
    value_or_fail(draw_run(map, log, run, stride, referenced.reference).save(pictures / ("scans" + extension)));
    for (std::size_t n = 1; n <= 12; ++n) {
      const std::size_t i = n * log.scans.size() / 13;
      if (!run.poses[i].has_pose) continue;
      char name[40];
      std::snprintf(name, sizeof name, "scan-%05zu%s", i, extension.c_str());
      value_or_fail(draw_scan(map, log, run.poses[i]).save(pictures / name));
    }
  }
  return run;
}

nlohmann::json report_of(const recording::LaserLog& log, const LogRun& run, const sensor_models::RayCaster& caster) {
  const double updates = static_cast<double>(std::max<std::size_t>(run.updates, 1));
  nlohmann::json report;
  report["scans"] = log.scans.size();
  if (!log.sources.empty()) report["sources"] = log.sources;
  report["notes"] = log.notes;
  report["updates"] = run.updates;
  report["seconds_per_scan"] = {
      {"first", run.seconds_first}, {"median", quantile(run.seconds, 0.5)}, {"p99", quantile(run.seconds, 0.99)}};
  report["localized_after_scans"] = run.localized_after ? nlohmann::json(*run.localized_after) : nlohmann::json();
  report["beams_used"] = static_cast<double>(run.beams_used) / updates;
  report["beams_filtered"] = static_cast<double>(run.beams_filtered) / updates;
  report["fit"] = run.fit;
  const auto near_walls = endpoints_near_walls(log, run, caster, 0.2);
  report["endpoints_near_walls"] = near_walls ? nlohmann::json(*near_walls) : nlohmann::json();
  const auto share = [&](auto is_so) {
    return static_cast<double>(std::count_if(run.poses.begin(), run.poses.end(), is_so)) /
           static_cast<double>(run.poses.size());
  };
  report["localized_fraction"] = share([](const LoggedPose& pose) { return pose.localized; });
  report["in_hindsight_fraction"] = share([](const LoggedPose& pose) { return !pose.localized && pose.hindsight; });
  report["taken_back_fraction"] = share([](const LoggedPose& pose) { return pose.is_taken_back(); });
  return report;
}

/// What was known in hindsight against the truth.
nlohmann::json score_of_hindsight(const LogRun& run, evaluation::ScanReference truth) {
  std::vector<evaluation::LocalizedScan> scans;
  for (const LoggedPose& pose : run.poses) {
    if (!pose.hindsight) truth[scans.size()].reset();
    scans.push_back({pose.hindsight, pose.hindsight.has_value()});
  }
  const evaluation::ReferenceScore score = evaluation::score_against(truth, scans, true);
  if (score.scans == 0) return {{"reference_scans", 0}};
  return {{"reference_scans", score.scans},
          {"mean_error_m", score.mean_m},
          {"p95_error_m", score.p95_m},
          {"max_error_m", score.max_m},
          {"lost_scans", score.lost}};
}

/// The run against the truth, where there is any.
void add_score(nlohmann::json& report, const LogRun& run, const evaluation::ScanReference& reference, bool reverse,
               bool start_is_known) {
  std::vector<evaluation::LocalizedScan> scans;
  for (const LoggedPose& pose : run.poses)
    scans.push_back({pose.has_pose ? std::optional{pose.map_from_base} : std::nullopt, pose.localized});
  evaluation::ScanReference truth = reference;
  if (reverse) {
    std::reverse(scans.begin(), scans.end());
    std::reverse(truth.begin(), truth.end());
  }
  const evaluation::ReferenceScore score = evaluation::score_against(truth, scans, start_is_known);
  report["reference_scans"] = score.scans;
  if (score.scans == 0) return;
  report["mean_error_m"] = score.mean_m;
  report["median_error_m"] = score.median_m;
  report["p95_error_m"] = score.p95_m;
  report["max_error_m"] = score.max_m;
  report["mean_heading_error_deg"] = score.mean_deg;
  report["max_heading_error_deg"] = score.max_deg;
  report["lost_scans"] = score.lost;
  report["lost_fraction"] = score.lost_fraction();
  report["sure_and_wrong_scans"] = score.sure_and_wrong;
  report["unsure_scans"] = score.unsure;
  report["in_hindsight"] = score_of_hindsight(run, reference);
}

nlohmann::json of_agreement(const RunAgreement& agreement) {
  if (agreement.both_know == 0)
    return {{"scans", agreement.scans}, {"both_know", 0},   {"within_half_a_metre_and_10_degrees", nullptr},
            {"median_m", nullptr},      {"p95_m", nullptr}, {"max_m", nullptr}};
  return {{"scans", agreement.scans},
          {"both_know", agreement.both_know},
          {"within_half_a_metre_and_10_degrees", agreement.share},
          {"median_m", agreement.median_m},
          {"p95_m", agreement.p95_m},
          {"max_m", agreement.max_m}};
}

nlohmann::json of_agreement(const std::vector<LoggedPose>& first, const std::vector<LoggedPose>& second) {
  nlohmann::json report = of_agreement(agreement_of(first, second));
  report["there_and_then"] = of_agreement(agreement_there_and_then(first, second));
  return report;
}

/// What both methods need, and the particles' own.
struct MethodParams {
  localization::LocalizerParams grid;
  localization::MonteCarloParams particles;
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

localization::HindsightParams hindsight_of(const MethodParams& params) {
  return {params.grid.tracks, params.grid.motion};
}

std::unique_ptr<localization::Localizer> make_localizer(const Options& options, const OccupancyGrid& map,
                                                        const MethodParams& params) {
  const localization::RangeTableCache cache{options.cache};
  if (options.method == "particles")
    return std::make_unique<localization::MonteCarloLocalizer>(map, params.grid, params.particles, cache, options.seed);
  return std::make_unique<localization::MarkovLocalizer>(map, params.grid, cache, options.seed);
}

MethodParams params_for(const Options& options, const OccupancyGrid& map, const recording::LaserLog& log,
                        double moving) {
  robot::RobotConfig config;
  value_or_fail(set_log_defaults(config, map, log.max_range, log.times_are_invented, moving));
  value_or_fail(config.set("localize.particles={most: 300000, reserve: 30000, draw_every: 1}"));  // there is time
  // Of its poses drawn elsewhere some always weigh: a set of particles is hardly ever sure over metres on end.
  // And raw odometry may veer by some degrees a metre, always to one side: where the grid's sea has neighbouring
  // headings in store, samples that all follow odometry must spread that far themselves.
  if (options.method == "particles") {
    value_or_fail(config.set("localize.verdict={confirmations: 3, travelled: 0.5, turned: 60}"));
    value_or_fail(config.set("localize.motion={rotation_per_metre: 0.005}"));
  }
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
double find_wall_depth(const Options& options, const ReferencedLog& log, const OccupancyGrid& map,
                       MethodParams params) {
  double best_depth = 0.0;
  double best_fit = 0.0;
  for (const double depth : {0.0, 0.2, 0.4}) {  // nearer ones differ less than two runs do
    params.grid.states.wall_depth = depth;
    localization::MarkovLocalizer localizer{map, params.grid, {options.cache}, options.seed};
    double fit = 0.0;
    for (const bool reverse : {false, true}) {
      localizer.start_unknown();
      fit += 0.5 * run_once(options, log, map, std::nullopt, localizer, reverse,
                            fmt::format("walls {:.1f} m deep", depth), {})
                       .fit;
    }
    std::fprintf(stderr, "walls %.1f m deep: mean ln P of a beam %.3f\n", depth, fit);
    if (depth > 0.0 && fit <= best_fit) continue;
    best_depth = depth;
    best_fit = fit;
  }
  return best_depth;
}

/// Refuses a start where no robot can be, and says where the nearest place is that can.
void check_start(const Options& options, const OccupancyGrid& map, const localization::StateSpace& space) {
  if (options.start == "unknown" || options.start == "reference") return;
  const Point2 start = parse_pose("--start", options.start).position();
  if (space.place_at(space.frame().cell_at(start)) != localization::StateSpace::kNoPlace) return;
  Point2 nearest = space.centre(0);
  for (std::size_t place = 1; place < space.places(); ++place)
    if (distance(space.centre(place), start) < distance(nearest, start)) nearest = space.centre(place);
  const CellIndex cell = map.frame.cell_at(start);
  const char* where = !map.frame.holds(cell)                    ? "outside the map"
                      : map.at(cell) == OccupancyGrid::kUnknown ? "where the map is unknown"
                                                                : "in a wall, or too near to one";
  throw CommandFailed{fmt::format("--start {}: this is {}; the nearest free place of {} is {:.2f},{:.2f}",
                                  options.start, where, options.map, nearest.x, nearest.y),
                      2};
}

/// A log without odometry can be read, but hardly be localized.
void say_still(const recording::LaserLog& log) {
  const auto stands = [&](const recording::LoggedScan& scan) {
    const Pose2& first = log.scans.front().odom_from_base;
    return distance(first.position(), scan.odom_from_base.position()) < 0.01 &&
           std::abs((scan.odom_from_base.theta - first.theta).degrees()) < 1.0;
  };
  if (log.scans.size() > 1 && std::all_of(log.scans.begin(), log.scans.end(), stands))
    std::fprintf(
        stderr,
        "note: the odometry of this log never moves: either the robot stood still, or the log has none, and "
        "then a way cannot be localized. Where the scans have poses, '--reference logged --odometry perturbed' "
        "makes odometry from them\n");
}

/// Whether people walk through it: [share of the readings].
double say_moving(const recording::LaserLog& log) {
  const double moving = moving_share(log);
  if (moving >= kCrowdShare)
    std::fprintf(stderr,
                 "note: people walk through this log (%.1f %% of the readings): what has their shape counts less\n",
                 100.0 * moving);
  return moving;
}

/// The log as it is localized: with the odometry that was asked for, and from the first scan whose pose is known where
/// the start is.
ReferencedLog load_log(const Options& options) {
  ReferencedLog referenced = load_referenced_log(options.choice);
  for (const std::string& note : referenced.log.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  value_or_fail(options.noise.validate(), 2);
  if (options.odometry == "perturbed") replace_odometry(referenced, options.noise, options.noise_seed);
  if (options.start == "reference") begin_where_known(referenced);
  return referenced;
}

void localize(const Options& options) {
  prepare_cache(options.cache);
  const OccupancyGrid map = load_and_say(options.map);
  const ReferencedLog referenced = load_log(options);
  const recording::LaserLog& log = referenced.log;
  const bool has_reference = !options.choice.reference.empty();
  const double moving = say_moving(log);
  MethodParams params = params_for(options, map, log, moving);
  const localization::StateSpace space{map, sensor_models::RayCaster{map}, params.grid.states};
  if (space.places() == 0) throw CommandFailed{options.map + ": no free place in this map"};
  check_start(options, map, space);
  say_still(log);
  if (options.wall_depth == "auto") {
    params.grid.states.wall_depth = find_wall_depth(options, referenced, map, params);
  } else {
    params.grid.states.wall_depth = parse_number("--wall-depth", options.wall_depth, "auto or a number [m]");
    value_or_fail(params.validate(), 2);
  }
  const auto localizer = make_localizer(options, map, params);

  const localization::HindsightParams hindsight = hindsight_of(params);
  const LogRun run =
      run_once(options, referenced, map, hindsight, *localizer, options.reverse, "localized", options.picture);
  const sensor_models::RayCaster caster{map};
  nlohmann::json report = report_of(log, run, caster);
  report["moving_share"] = moving;
  report["map"] = options.map;
  report["log"] = options.choice.log;
  report["scans_used"] = options.choice.scans;
  report["odometry"] = options.odometry;
  report["dead_reckoning"] = options.dead_reckoning;
  if (has_reference) add_score(report, run, referenced.reference, options.reverse, options.start != "unknown");
  report["method"] = options.method;
  report["filter"] = options.filter;
  report["start"] = options.start;
  report["reversed"] = options.reverse;
  report["wall_depth"] = params.grid.states.wall_depth;
  std::printf("%s, by the method %s, %s start\n%s", options.reverse ? "reversed" : "forward", options.method.c_str(),
              options.start == "unknown" ? "unknown" : "given", summary_of_run(report).c_str());
  if (options.both_ways) {
    localizer->start_unknown();
    const LogRun other =
        run_once(options, referenced, map, hindsight, *localizer, !options.reverse, "the other way", options.picture);
    report["other_way"] = report_of(log, other, caster);
    if (has_reference)
      add_score(report["other_way"], other, referenced.reference, !options.reverse, options.start == "reference");
    report["agreement"] = of_agreement(run.poses, other.poses);
    std::printf("the other way, unknown start\n%s", summary_of_run(report["other_way"]).c_str());
    std::printf("both ways\n%s", summary_of_agreement(report["agreement"]).c_str());
  }
  if (!options.compare.empty()) {
    const auto others = value_or_fail(load_poses(options.compare));
    if (others.size() != run.poses.size()) throw CommandFailed{options.compare + ": poses of another log"};
    report["agreement"] = of_agreement(run.poses, others);
    std::printf("beside %s\n%s", options.compare.c_str(), summary_of_agreement(report["agreement"]).c_str());
  }
  if (!options.poses.empty()) value_or_fail(save_poses(run.poses, options.poses));
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
}

}  // namespace

void add_localize_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("localize", "Localize a recorded log in a map");
  command->add_option("--map", options->map, "map_server YAML file")->required();
  add_log_options(*command, options->choice);
  command->add_option("--method", options->method, "grid, particles")
      ->check(CLI::IsMember({"grid", "particles"}))
      ->capture_default_str();
  command->add_option("--filter", options->filter, "none, entropy, distance, novelty")
      ->check(CLI::IsMember({"none", "entropy", "distance", "novelty"}))
      ->capture_default_str();
  command
      ->add_option("--start", options->start,
                   "unknown, or X,Y,DEG of the first scan that is offered (with --reverse the last of the log), or "
                   "reference: where the reference says, from the first scan that has one")
      ->capture_default_str();
  command
      ->add_option("--odometry", options->odometry,
                   "logged, or perturbed: the reference's own way with errors drawn from --odometry-seed")
      ->check(CLI::IsMember({"logged", "perturbed"}))
      ->capture_default_str();
  add_seed(*command, "--odometry-seed", options->noise_seed, "seed of perturbed odometry");
  command
      ->add_option(
          "--odometry-noise", options->noise.way_share,
          "deviation of each perturbed way and turn, as a share of it; half a degree a metre and more come on top")
      ->capture_default_str();
  command->add_flag("--dead-reckoning", options->dead_reckoning,
                    "crippled, to compare with: odometry alone once the robot knows where it is");
  command->add_flag("--reverse", options->reverse, "from the last scan to the first, with inverse odometry");
  command->add_flag("--both-ways", options->both_ways, "forward and reversed, and how they agree");
  command->add_option("--compare", options->compare, "poses of another run over this log");
  command->add_option("--poses", options->poses, "CSV file to write: the pose of every scan")->check(output_file());
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->add_option("--picture", options->picture, "folder for pictures: the belief, the scans in the map")
      ->check(output_folder());
  add_picture_format(*command, options->picture_format);
  command
      ->add_option("--wall-depth", options->wall_depth,
                   "[m] how deep inside the map's walls their surface lies, or auto: what explains the log best")
      ->capture_default_str();
  command->add_option("--set", options->settings, "key=value of the localizer's parameters, e.g. beams=90");
  add_seed(*command, "--seed", options->seed, "seed of the random choice of beams");
  add_cache_options(*command, options->cache);
  command->callback([options] {
    options->noise.turn_share = options->noise.way_share;
    localize(*options);
  });
}

}  // namespace docent::apps::localize_command
