#include "docent/apps/localize/map_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/localize/localize_log.h"
#include "docent/apps/localize/log_reference.h"
#include "docent/apps/localize/map_poses.h"
#include "docent/apps/localize/scan_odometry.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/evaluation/reference/relations.h"
#include "docent/mapping/expectation_maximization/em_mapper.h"
#include "docent/mapping/expectation_maximization/odometry_calibration.h"
#include "docent/mapping/occupancy/scan_mapper.h"
#include "docent/pictures/map_picture.h"

namespace docent::apps::localize_command {
namespace {

struct MapOptions {
  LogChoice choice;
  std::string method = "auto";
  std::string relations;
  std::string poses;
  std::string odometry = "logged";
  evaluation::OdometryNoiseParams noise;
  std::uint64_t seed = 1;
  std::string out;
  std::string report;
  std::string picture_format = "png";
  std::vector<std::string> settings;
};

mapping::ScanMapperParams params_of(const std::vector<std::string>& settings, int fewest_hits) {
  mapping::ScanMapperParams params;
  params.fewest_hits = fewest_hits;
  std::string yaml;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) throw CommandFailed{"--set " + setting + ": expected key=value", 2};
    yaml += setting.substr(0, equals) + ": " + setting.substr(equals + 1) + "\n";
  }
  if (!yaml.empty()) {
    const auto file = value_or_fail(YamlFile::parse(yaml, "--set"), 2);
    value_or_fail(read_yaml(file, file.root(), params), 2);
  }
  value_or_fail(params.validate(), 2);
  return params;
}

std::vector<mapping::PlacedSweep> placed_sweeps(const ReferencedLog& referenced) {
  std::vector<mapping::PlacedSweep> placed;
  for (std::size_t i = 0; i < referenced.log.scans.size(); ++i) {
    const recording::LoggedScan& scan = referenced.log.scans[i];
    if (!referenced.reference[i]) continue;
    placed.push_back({sweep_of(scan, referenced.log.max_range), *referenced.reference[i] * scan.base_from_laser});
  }
  return placed;
}

/// Of the scans that are placed, in the order of the log.
std::vector<Pose2> poses_of_placed(const ReferencedLog& placed) {
  std::vector<Pose2> poses;
  for (const auto& pose : placed.reference)
    if (pose) poses.push_back(*pose);
  return poses;
}

pictures::Figure draw(const OccupancyGrid& map, const std::vector<mapping::PlacedSweep>& placed) {
  constexpr double kScanDot = 2.0;  // [points]
  pictures::Figure figure{"Map of " + std::to_string(placed.size()) + " scans"};
  pictures::Axes& axes = figure.add(pictures::Axes::metres(map.frame));
  pictures::draw_map(axes, map);
  std::vector<Point2> way;
  for (const mapping::PlacedSweep& sweep : placed) way.push_back(sweep.map_from_sensor.position());
  pictures::draw_points(axes, way, kScanDot, pictures::distinct(0));
  pictures::add_map_legend(figure);
  figure.add_legend(pictures::legend_disc("laser at a scan", kScanDot, pictures::distinct(0)));
  return figure;
}

/// Poses by matching scans, with a line of progress now and then.
std::vector<Pose2> poses_by_graph(const recording::LaserLog& log, const ChosenScans& chosen,
                                  const mapping::GraphMapperParams& params, const std::string& doubt,
                                  nlohmann::json& report) {
  std::size_t told = 0;
  auto map = mapping::map_by_graph(chosen.scans, params, [&](const mapping::MappingProgress& progress) {
    if (progress.stage == "chain" && progress.done < told + 300) return;
    if (progress.stage == "loops" && progress.done < told + 300 && progress.done > told) return;
    told = progress.done;
    std::fprintf(stderr, "%s: %zu of %zu scans, %zu loops\n", progress.stage.c_str(), progress.done, progress.of,
                 progress.loops);
  });
  if (map.judgement.is_trusted && !doubt.empty()) {
    map.judgement.is_trusted = false;
    map.judgement.reason = doubt;
  }
  report["scans_matched"] = chosen.scans.size();
  report["loops"] = map.loops;
  report["loops_refused"] = map.loops_refused;
  report["scans_by_odometry"] = map.unmatched;
  report["revisits"] = map.revisits;
  report["revisit_error_m"] = map.revisit_error;
  report["judgement"] = {{"is_trusted", map.judgement.is_trusted},
                         {"reason", map.judgement.reason},
                         {"pairs", map.judgement.pairs},
                         {"in_conflict", map.judgement.in_conflict},
                         {"mean_conflict", map.judgement.mean_conflict},
                         {"expected_error_m", map.judgement.expected_error},
                         {"odometry_scale", map.judgement.odometry_scale}};
  if (!map.judgement.is_trusted)
    std::fprintf(stderr, "warning: do not trust this map: %s\n", map.judgement.reason.c_str());
  std::printf("%zu loops; %zu pairs of scans of one place agree to %.3f m\n", map.loops, map.revisits,
              map.revisit_error);
  return poses_of_all(log, chosen.indices, map.map_from_base);
}

pictures::Figure draw_iteration(const mapping::EmProgress& progress) {
  const OccupancyGrid grid = progress.map.picture();
  pictures::Figure figure{"Expectation maximization, level " + std::to_string(progress.level + 1) + ", iteration " +
                          std::to_string(progress.iteration)};
  pictures::Axes& axes = figure.add(pictures::Axes::metres(grid.frame));
  pictures::draw_map(axes, grid);
  std::vector<Point2> way;
  for (const Pose2& pose : progress.poses) way.push_back(pose.position());
  pictures::draw_points(axes, way, 2.0, pictures::distinct(0));
  return figure;
}

/// Poses by expectation maximization alone, with a picture of each iteration.
std::vector<Pose2> poses_by_em(const recording::LaserLog& log, const ChosenScans& chosen, const MapOptions& options,
                               nlohmann::json& report) {
  nlohmann::json iterations = nlohmann::json::array();
  mapping::EmMapperParams params;
  const mapping::GraphMapperParams matching;
  const mapping::ScanChain chain{matching.chain, matching.chain_grid, matching.lines};
  const auto calibration = mapping::calibrate_odometry(chosen.scans, chain_of(chosen.scans, chain), params);
  params.way_per_metre = calibration.way_per_metre;
  params.way_per_radian = calibration.way_per_radian;
  params.turn_per_metre = calibration.turn_per_metre;
  params.turn_per_radian = calibration.turn_per_radian;
  std::fprintf(
      stderr,
      "odometry: ways times %.3f, turns times %.3f, %.2f degrees a metre; then %.3f m and %.2f degrees after a metre\n",
      calibration.way_scale, calibration.turn_scale, calibration.veer * 57.2958, std::sqrt(calibration.way_per_metre),
      std::sqrt(calibration.turn_per_metre) * 57.2958);
  const auto scans = with_odometry_corrected(chosen.scans, calibration);
  const auto map = mapping::map_by_em(scans, params, [&](const mapping::EmProgress& progress) {
    std::fprintf(stderr, "level %d, iteration %d: ln p(d | m) %.0f, poses moved by %.2f m\n", progress.level + 1,
                 progress.iteration, progress.log_likelihood, std::min(progress.moved, 999.0));
    iterations.push_back({{"level", progress.level + 1},
                          {"iteration", progress.iteration},
                          {"log_likelihood", progress.log_likelihood}});
    const std::string name = fmt::format("em-{}-{}.{}", progress.level + 1, progress.iteration, options.picture_format);
    value_or_fail(draw_iteration(progress).save(std::filesystem::path{options.out} / name));
    return true;
  });
  report["places"] = map.scans.size();
  report["iterations"] = iterations;
  std::vector<std::size_t> indices;
  for (const std::size_t scan : map.scans) indices.push_back(chosen.indices[scan]);
  return poses_of_all(log, indices, map.map_from_base);
}

constexpr const char* kByScans = "scan matching alone";

/// Poses of all scans, and of which of them the map is made: a robot that stands sees one visitor a thousand times.
struct LearnedPoses {
  std::vector<Pose2> map_from_base;
  std::vector<std::size_t> sources;
};

LearnedPoses learned_poses(recording::LaserLog& log, const MapOptions& options, nlohmann::json& report) {
  const mapping::GraphMapperParams params;
  std::string doubt;
  report["placed_by"] = options.method == "odometry" ? "odometry"
                        : options.method == "em"     ? "odometry and expectation maximization"
                                                     : "odometry and scan matching";
  if (has_no_odometry(log)) {
    if (options.method == "odometry")
      throw CommandFailed{options.choice.log +
                          ": there is no odometry, or it never moves: --method graph maps by the scans"};
    report["placed_by"] = kByScans;
    std::fprintf(stderr,
                 "there is no odometry, or it never moves: the robot's way is that on which scans fit together\n");
    const ScanOdometry by_scans = odometry_by_scans(log, params);
    report["steps_that_scans_do_not_tell"] = by_scans.blind;
    doubt = by_scans.doubt();
    std::erase_if(log.notes, [](const std::string& note) { return note.starts_with("there is no odometry"); });
    log.notes.emplace_back("there is no odometry, or it never moves: the map is made by scan matching alone");
  }
  const ChosenScans chosen = choose_scans(log, {}, params.points);
  if (options.method == "odometry") {
    LearnedPoses reckoned{{}, chosen.sources};
    for (const recording::LoggedScan& scan : log.scans) reckoned.map_from_base.push_back(scan.odom_from_base);
    return reckoned;
  }
  return {options.method == "em" ? poses_by_em(log, chosen, options, report)
                                 : poses_by_graph(log, chosen, params, doubt, report),
          chosen.sources};
}

/// As --reference reads them.
void save_poses(const std::string& path, const recording::LaserLog& log, const std::vector<Pose2>& poses) {
  std::string text = "# time x y theta: s, m, m, rad\n";
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (log.scans[i].rear) continue;
    text += fmt::format("{:.6f} {:.4f} {:.4f} {:.5f}\n", to_seconds(log.scans[i].time), poses[i].x, poses[i].y,
                        poses[i].theta.radians());
  }
  value_or_fail(write_file_atomically(path, text));
}

void score(const MapOptions& options, const recording::LaserLog& log, const std::vector<Pose2>& poses,
           const evaluation::ScanReference& truth, nlohmann::json& report) {
  std::vector<evaluation::TimedPose> timed;
  std::vector<evaluation::TimedPose> known;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (log.scans[i].rear) continue;
    timed.push_back({log.scans[i].time, poses[i]});
    if (truth[i]) known.push_back({log.scans[i].time, *truth[i]});
  }
  std::vector<evaluation::Relation> relations;
  if (!options.relations.empty()) {
    relations = value_or_fail(evaluation::load_relations(options.relations));
  } else if (!known.empty()) {
    constexpr double kApart[] = {1.0, 5.0, 20.0, 60.0, 150.0};
    relations = evaluation::relations_between(known, kApart);
  } else {
    return;
  }
  const auto scored = evaluation::score_relations(relations, timed);
  report["relations"] = {
      {"relations", scored.relations},       {"metres", scored.metres},   {"metres_spread", scored.metres_spread},
      {"metres_worst", scored.metres_worst}, {"degrees", scored.degrees}, {"degrees_spread", scored.degrees_spread}};
  std::printf("relations: %zu, translational error %.3f +- %.3f m (worst %.2f), rotational %.2f +- %.2f degrees\n",
              scored.relations, scored.metres, scored.metres_spread, scored.metres_worst, scored.degrees,
              scored.degrees_spread);
}

/// How far off the made-up odometry is in the end.
void note_end_error(const ReferencedLog& referenced, nlohmann::json& report) {
  double way = 0.0;
  for (std::size_t i = 1; i < referenced.reference.size(); ++i) {
    way += distance(referenced.reference[i - 1]->position(), referenced.reference[i]->position());
  }
  const Pose2 by_odometry =
      inverse(referenced.log.scans.front().odom_from_base) * referenced.log.scans.back().odom_from_base;
  const Pose2 truly = inverse(*referenced.reference.front()) * *referenced.reference.back();
  report["odometry"] = {{"way_m", way},
                        {"end_error_m", distance(by_odometry.position(), truly.position())},
                        {"end_error_deg", std::abs((by_odometry.theta - truly.theta).degrees())}};
}

void make_map(const MapOptions& options) {
  const std::filesystem::path out{options.out};
  std::error_code code;
  std::filesystem::create_directories(out, code);
  if (code) throw CommandFailed{options.out + ": cannot be made: " + code.message()};
  (void)params_of(options.settings, 1);  // mistakes show before the work
  // What odometry places between known poses would blur the walls: good enough to judge by, not to map.
  evaluation::ReferenceGaps gaps;
  gaps.between_own_scans = false;
  nlohmann::json report;
  ReferencedLog referenced = load_referenced_log(options.choice, gaps);
  if (options.odometry == "perturbed") replace_odometry(referenced, options.noise, options.seed);
  const evaluation::ScanReference truth = referenced.reference;
  if (options.odometry == "perturbed") note_end_error(referenced, report);
  const bool is_known =
      options.method == "known-poses" || (options.method == "auto" && !options.choice.reference.empty());
  if (is_known && !(options.relations.empty() && options.poses.empty()))
    throw CommandFailed{"--relations and --poses are of maps whose poses are learned (--method graph)", 2};
  report["placed_by"] = "the reference";
  if (!is_known) {
    const LearnedPoses learned = learned_poses(referenced.log, options, report);
    const std::vector<Pose2>& poses = learned.map_from_base;
    std::fill(referenced.reference.begin(), referenced.reference.end(), std::nullopt);
    for (const std::size_t i : learned.sources) referenced.reference[i] = poses[i];
    score(options, referenced.log, poses, truth, report);
    if (!options.poses.empty()) save_poses(options.poses, referenced.log, poses);
  }
  for (const std::string& note : referenced.log.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  const mapping::ScanMapperParams params =
      params_of(options.settings, is_known ? 1 : mapping::fewest_hits_of(poses_of_placed(referenced)));
  const std::vector<mapping::PlacedSweep> placed = placed_sweeps(referenced);
  if (placed.empty()) throw CommandFailed{options.choice.log + ": no scan has a pose (--reference)"};
  mapping::ScanMapper mapper{value_or_fail(mapping::ScanMapper::frame_of(placed, params)), params};
  for (std::size_t i = 0; i < placed.size(); ++i) {
    mapper.add(placed[i]);
    if ((i + 1) % 500 == 0) std::fprintf(stderr, "%zu of %zu scans\n", i + 1, placed.size());
  }
  const OccupancyGrid map = mapper.map();
  value_or_fail(save_map(map, out / "map"));
  value_or_fail(draw(map, placed).save(out / ("map." + options.picture_format)));
  const auto share = [&](std::int8_t kind) {
    return static_cast<double>(std::count(map.cells.begin(), map.cells.end(), kind)) * params.resolution *
           params.resolution;
  };
  report.update(nlohmann::json{{"log", options.choice.log},
                               {"scans", referenced.log.scans.size()},
                               {"sources", referenced.log.sources},
                               {"notes", referenced.log.notes},
                               {"scans_with_a_pose", placed.size()},
                               {"columns", map.frame.columns},
                               {"rows", map.frame.rows},
                               {"resolution", params.resolution},
                               {"free_m2", share(OccupancyGrid::kFree)},
                               {"occupied_m2", share(OccupancyGrid::kOccupied)}});
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
  const bool is_by_scans = report["placed_by"] == kByScans;
  std::printf("%s: %d x %d cells of %.2f m, %.0f m2 free, from %zu of %zu scans%s\n", (out / "map.yaml").c_str(),
              map.frame.columns, map.frame.rows, params.resolution, report["free_m2"].get<double>(), placed.size(),
              referenced.log.scans.size(), is_by_scans ? ", placed by scan matching alone: there is no odometry" : "");
}

}  // namespace

void add_map_command(CLI::App& app) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand("map", "Make a map from a recorded log");
  add_log_options(*command, options->choice);
  command->add_option("--out", options->out, "folder for map.yaml, map.pgm and a picture, map.png")
      ->check(output_folder())
      ->required();
  command
      ->add_option("--method", options->method,
                   "known-poses: scans are placed where --reference says; graph: where they fit together; em: by "
                   "expectation maximization; odometry: as it stands, to compare; auto: known-poses or graph, as "
                   "--reference is given or not")
      ->check(CLI::IsMember({"auto", "known-poses", "graph", "em", "odometry"}))
      ->capture_default_str();
  add_picture_format(*command, options->picture_format);
  command->add_option("--relations", options->relations,
                      "score: true relations between places, lines of \"t1 t2 x y z roll pitch yaw\"");
  command
      ->add_option("--odometry", options->odometry,
                   "perturbed: odometry of our making, seeded errors along --reference")
      ->check(CLI::IsMember({"logged", "perturbed"}));
  command->add_option("--odometry-turn", options->noise.turn_per_metre, "of it: deviation of the heading [rad/m]")
      ->capture_default_str();
  command
      ->add_option("--odometry-veer", options->noise.veer,
                   "of it: deviation of the turn that comes with all ways of a run [rad/m]")
      ->capture_default_str();
  add_seed(*command, "--odometry-seed", options->seed, "seed of perturbed odometry");
  command
      ->add_option("--poses", options->poses, "file to write: where each scan was taken, lines of \"time x y theta\"")
      ->check(output_file());
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->add_option("--set", options->settings, "key=value of the mapper's parameters, e.g. resolution=0.1");
  command->callback([options] { make_map(*options); });
}

}  // namespace docent::apps::localize_command
