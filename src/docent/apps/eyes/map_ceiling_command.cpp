#include "docent/apps/eyes/map_ceiling_command.h"

#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "docent/apps/eyes/ceiling_figure.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log.h"
#include "docent/base/files.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/vision/ceiling/drive/ceiling_drive.h"
#include "docent/vision/ceiling/mosaic_file.h"

namespace docent::apps::map_ceiling_command {
namespace {

constexpr double kPictureCell = 0.05;  // [m] of the mosaics in pictures, at least

struct Options {
  std::string drive;
  std::string out;
  std::string stages;
  std::string figure;
  std::string poses;
  std::string report;
  std::string picture_format = "png";
  double seconds = 0.0;
  bool one_height = false, one_light = false, no_priors = false;
  vision::MosaicSolverParams params;
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Tells how far it is, draws the stages, and ends the work when its time is over or somebody asks for it.
class Watch {
 public:
  explicit Watch(const Options& options) : options_{options} {}

  bool hear(const vision::MosaicStage& stage) {
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    if (progress_.is_due(stage.share, wall)) {
      char line[160];
      std::snprintf(line, sizeof line, "%3.0f %%, %.0f s: %s", 100.0 * stage.share, wall, stage.name.c_str());
      std::fputs(progress_.shown(line).c_str(), stderr);
    }
    if (stage.is_end && !options_.stages.empty()) draw(stage);
    is_cut_short_ = is_asked_to_end || (options_.seconds > 0.0 && wall > options_.seconds);
    return !is_cut_short_;
  }
  void end() const { std::fputs(progress_.end().c_str(), stderr); }
  [[nodiscard]] bool is_cut_short() const { return is_cut_short_; }
  /// [s] of the processor that pictures of stages took.
  [[nodiscard]] double drawing_seconds() const { return drawing_; }

  static inline std::atomic<bool> is_asked_to_end{false};  // by a signal, which knows no object

 private:
  void draw(const vision::MosaicStage& stage) {
    const double before = processor_seconds();
    const auto mosaic = vision::drawn(stage.so_far, options_.params, kPictureCell);
    char name[32];
    std::snprintf(name, sizeof name, "stage-%d.", ++drawn_);
    value_or_fail(draw_stage(mosaic, stage.so_far, stage.name)
                      .save(std::filesystem::path{options_.stages} / (name + options_.picture_format)));
    drawing_ += processor_seconds() - before;
  }

  const Options& options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Progress progress_{::isatty(STDERR_FILENO) != 0};
  int drawn_ = 0;
  double drawing_ = 0.0;
  bool is_cut_short_ = false;
};

/// As the believed ones were given.
void save_poses(const std::string& path, const vision::CeilingDrive& drive, const vision::SolvedMosaic& solved) {
  std::string text = "picture,map_x,map_y,map_theta,gain,offset\n";
  for (std::size_t i = 0; i < solved.pictures.size(); ++i) {
    const auto& placed = solved.pictures[i];
    const Pose2& pose = placed.map_from_robot;
    char line[160];
    std::snprintf(line, sizeof line, "%06d,%.5f,%.5f,%.6f,%.4f,%.4f\n", drive.numbers[i], pose.x, pose.y,
                  pose.theta.radians(), placed.gain, placed.offset);
    text += line;
  }
  value_or_fail(write_file_atomically(path, text));
}

/// [m] root of the mean square way from the believed poses to those found.
double moved(const vision::CeilingDrive& drive, const vision::SolvedMosaic& solved) {
  double squares = 0.0;
  for (std::size_t i = 0; i < solved.pictures.size(); ++i) {
    const double way = distance(solved.pictures[i].map_from_robot.position(), drive.map_from_robot[i].position());
    squares += way * way;
  }
  return std::sqrt(squares / static_cast<double>(solved.pictures.size()));
}

/// [degrees] by which the camera was found to look another way than it is said to.
double turned(const vision::CeilingDrive& drive, const vision::SolvedMosaic& solved) {
  const Eigen::Matrix3d& told = drive.camera.mount.robot_from_camera;
  return Eigen::AngleAxisd{solved.camera.mount.robot_from_camera * told.transpose()}.angle() / kDegree;
}

nlohmann::json place_in_report(const vision::CameraMount& mount) {
  const modules::EyePlace place = modules::place_of(mount);
  return {{"x", place.x},     {"y", place.y},       {"z", place.z},
          {"pan", place.pan}, {"tilt", place.tilt}, {"roll", place.roll}};
}

nlohmann::json parts_of(const vision::CeilingMosaic& mosaic) {
  std::vector<std::size_t> cells(mosaic.heights.size());
  for (const std::uint8_t part : mosaic.part)
    if (part != vision::CeilingMosaic::kUnknown) ++cells[part];
  nlohmann::json parts = nlohmann::json::array();
  for (std::size_t i = 0; i < cells.size(); ++i)
    parts.push_back({{"height_m", mosaic.heights[i]},
                     {"area_m2", static_cast<double>(cells[i]) * mosaic.frame.resolution * mosaic.frame.resolution}});
  return parts;
}

void map_ceiling(Options& options) {
  options.params.solve_heights = !options.one_height;
  options.params.solve_light = !options.one_light;
  options.params.use_priors = !options.no_priors;
  value_or_fail(options.params.validate(), 2);
  if (std::filesystem::path{options.out}.extension() != ".yaml")
    throw CommandFailed{"--out " + options.out + ": expected a name that ends in .yaml", 2};
  if (!options.stages.empty()) std::filesystem::create_directories(options.stages);
  const vision::CeilingDrive drive = value_or_fail(vision::read_ceiling_drive(options.drive));
  const double before = processor_seconds();
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { Watch::is_asked_to_end = true; });
  Watch watch{options};
  auto solved = vision::solve_mosaic(drive.camera, drive.placed(), options.params,
                                     [&](const vision::MosaicStage& stage) { return watch.hear(stage); });
  watch.end();
  if (!solved) throw CommandFailed{options.drive + ": " + solved.error().message};
  const double seconds = processor_seconds() - before - watch.drawing_seconds();
  solved->mosaic.is_cut_short = watch.is_cut_short();
  value_or_fail(vision::write_ceiling(options.out, solved->mosaic));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
  const double off = std::sqrt(solved->squares) * options.params.pair.brightness;
  if (!options.poses.empty()) save_poses(options.poses, drive, *solved);
  if (!options.figure.empty()) {
    vision::SolvedMosaic believed = *solved;
    believed.pictures = drive.placed();
    believed.camera = drive.camera;
    believed.field = {};
    value_or_fail(draw_mosaic(vision::drawn(believed, options.params, kPictureCell),
                              vision::drawn(*solved, options.params, kPictureCell),
                              "Mosaic of a ceiling from " + std::to_string(drive.bytes.size()) + " pictures")
                      .save(options.figure));
  }
  const nlohmann::json report{{"pictures", drive.bytes.size()},
                              {"unknowns", solved->unknowns},
                              {"residuals", solved->residuals},
                              {"moved_rms_m", moved(drive, *solved)},
                              {"residual_rms", off},
                              {"mount_turned_deg", turned(drive, *solved)},
                              {"place", place_in_report(solved->camera.mount)},
                              {"parts", parts_of(solved->mosaic)},
                              {"seconds", seconds},
                              {"megabytes", megabytes},
                              {"cut_short", watch.is_cut_short()}};
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, report.dump(2) + "\n"));
  std::printf(
      "%zu pictures, %zu unknowns: poses moved by %.3f m (RMS), pictures differ by %.3f of 0 to 1 (RMS); the "
      "camera looks %.2f degrees beside what is said\n",
      drive.bytes.size(), solved->unknowns, moved(drive, *solved), off, turned(drive, *solved));
  const modules::EyePlace place = modules::place_of(solved->camera.mount);
  std::printf(
      "robot.yaml should say   ceiling: {place: {x: %.3f, y: %.3f, z: %.3f, pan: %.2f, tilt: %.2f, roll: %.2f}}\n",
      place.x, place.y, place.z, place.pan, place.tilt, place.roll);
  for (const auto& part : report["parts"])
    std::printf("%8.3f m high: %.1f m2\n", part["height_m"].get<double>(), part["area_m2"].get<double>());
  std::printf("%s: %d x %d cells; %.1f s of one core, %.0f MB%s\n", options.out.c_str(), solved->mosaic.frame.columns,
              solved->mosaic.frame.rows, seconds, megabytes,
              watch.is_cut_short() ? "; cut short, as the file says" : "");
}

}  // namespace

void add_map_ceiling_command(CLI::App& app) {
  auto* command = app.add_subcommand("map-ceiling", "Make a mosaic of the ceiling, of pictures of a drive");
  auto options = std::make_shared<Options>();
  command
      ->add_option("drive", options->drive,
                   "Folder with cameras.yaml, poses.csv (picture, map_x, map_y, map_theta) and up/NNNNNN.png, as "
                   "docent-lab take-pictures writes it")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "Ceiling to write: NAME.yaml, with two images beside it")
      ->required()
      ->check(output_file());
  command->add_option("--pictures", options->stages, "Folder for a picture of every stage")->check(output_folder());
  add_picture_format(*command, options->picture_format);
  command->add_option("--figure", options->figure, "SVG, PDF or PNG file to write: before and after, and the heights")
      ->check(output_picture());
  command
      ->add_option("--poses", options->poses, "CSV file to write: the poses that were found, and each picture's light")
      ->check(output_file());
  command->add_option("--report", options->report, "JSON file to write: figures of the run")->check(output_file());
  command
      ->add_option("--seconds", options->seconds,
                   "[s] to end after, with what there is by then, as Ctrl-C does; 0: when it is done")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--resolution", options->params.resolution, "[m] of the mosaic's cells")
      ->check(CLI::Range(0.005, 0.5))
      ->capture_default_str();
  command->add_flag("--one-height", options->one_height, "All of the ceiling has one height, which is not solved for");
  command->add_flag("--one-light", options->one_light, "All pictures have the same light");
  command->add_flag("--no-priors", options->no_priors, "The believed poses are where the search starts, and no more");
  command->callback([options] { map_ceiling(*options); });
}

}  // namespace docent::apps::map_ceiling_command
