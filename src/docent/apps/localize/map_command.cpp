#include "docent/apps/localize/map_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/localize/localize_log.h"
#include "docent/apps/localize/log_reference.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/base/yaml.h"
#include "docent/mapping/occupancy/scan_mapper.h"
#include "docent/pictures/map_picture.h"

namespace docent::apps {
namespace {

struct MapOptions {
  LogChoice choice;
  std::string method = "known-poses";
  std::string out;
  std::string report;
  std::string picture_format = "png";
  std::vector<std::string> settings;
};

mapping::ScanMapperParams params_of(const std::vector<std::string>& settings) {
  mapping::ScanMapperParams params;
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

void make_map(const MapOptions& options) {
  const mapping::ScanMapperParams params = params_of(options.settings);
  // What odometry places between known poses would blur the walls: good enough to judge by, not to map.
  evaluation::ReferenceGaps gaps;
  gaps.between_own_scans = false;
  const ReferencedLog referenced = load_referenced_log(options.choice, gaps);
  for (const std::string& note : referenced.log.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  const std::vector<mapping::PlacedSweep> placed = placed_sweeps(referenced);
  if (placed.empty()) throw CommandFailed{options.choice.log + ": no scan has a pose (--reference)"};
  mapping::ScanMapper mapper{value_or_fail(mapping::ScanMapper::frame_of(placed, params)), params};
  for (std::size_t i = 0; i < placed.size(); ++i) {
    mapper.add(placed[i]);
    if ((i + 1) % 500 == 0) std::fprintf(stderr, "%zu of %zu scans\n", i + 1, placed.size());
  }
  const OccupancyGrid map = mapper.map();
  const std::filesystem::path out{options.out};
  std::error_code code;
  std::filesystem::create_directories(out, code);
  if (code) throw CommandFailed{options.out + ": cannot be made: " + code.message()};
  value_or_fail(save_map(map, out / "map"));
  value_or_fail(draw(map, placed).save(out / ("map." + options.picture_format)));
  const auto share = [&](std::int8_t kind) {
    return static_cast<double>(std::count(map.cells.begin(), map.cells.end(), kind)) * params.resolution *
           params.resolution;
  };
  const nlohmann::json report{{"log", options.choice.log},
                              {"scans", referenced.log.scans.size()},
                              {"scans_with_a_pose", placed.size()},
                              {"columns", map.frame.columns},
                              {"rows", map.frame.rows},
                              {"resolution", params.resolution},
                              {"free_m2", share(OccupancyGrid::kFree)},
                              {"occupied_m2", share(OccupancyGrid::kOccupied)}};
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
  std::printf("%s: %d x %d cells of %.2f m, %.0f m2 free, from %zu of %zu scans\n", (out / "map.yaml").c_str(),
              map.frame.columns, map.frame.rows, params.resolution, report["free_m2"].get<double>(), placed.size(),
              referenced.log.scans.size());
}

}  // namespace

void add_map_command(CLI::App& app) {
  auto options = std::make_shared<MapOptions>();
  CLI::App* command = app.add_subcommand("map", "Make a map from a recorded log");
  add_log_options(*command, options->choice);
  command->add_option("--out", options->out, "folder for map.yaml, map.pgm and a picture, map.png")
      ->check(output_folder())
      ->required();
  command->add_option("--method", options->method, "known-poses: scans are placed where --reference says")
      ->check(CLI::IsMember({"known-poses"}))
      ->capture_default_str();
  add_picture_format(*command, options->picture_format);
  command->add_option("--report", options->report, "JSON file to write")->check(output_file());
  command->add_option("--set", options->settings, "key=value of the mapper's parameters, e.g. resolution=0.1");
  command->callback([options] { make_map(*options); });
}

}  // namespace docent::apps
