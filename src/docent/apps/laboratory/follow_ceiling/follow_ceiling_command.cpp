#include "docent/apps/laboratory/follow_ceiling/follow_ceiling_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/vision/ceiling/drive/ceiling_drive.h"
#include "docent/vision/ceiling/localizer/ceiling_localizer.h"
#include "docent/vision/ceiling/mosaic_file.h"

namespace docent::apps::follow_ceiling_command {
namespace {

struct FollowOptions {
  std::string ceiling, drive, out;
  std::vector<double> place;
  int restart = 50;
  bool is_mirrored = false;
};

/// Poses of a file of comma-separated numbers with a first line of names, from the column `first` on: x, y, theta.
Result<std::vector<Pose2>> read_poses(const std::filesystem::path& path, std::size_t first) {
  const auto text = read_file(path);
  if (!text) return tl::unexpected<Error>(text.error());
  std::vector<Pose2> poses;
  std::size_t begin = text->find('\n');
  for (int line = 2; begin != std::string::npos && begin + 1 < text->size(); ++line) {
    const std::size_t end = text->find('\n', begin + 1);
    std::vector<double> numbers;
    std::size_t at = begin + 1;
    while (at < std::min(end, text->size())) {
      char* after = nullptr;
      numbers.push_back(std::strtod(text->c_str() + at, &after));
      at = static_cast<std::size_t>(after - text->c_str()) + 1;
    }
    if (numbers.size() < first + 3)
      return fail(path.string() + ":" + std::to_string(line) + ": expected " + std::to_string(first + 3) + " numbers");
    poses.push_back({numbers[first], numbers[first + 1], Angle::radians(numbers[first + 2])});
    begin = end;
  }
  return poses;
}

void run(const FollowOptions& options) {
  const std::filesystem::path folder = options.drive;
  const auto mosaic = value_or_fail(vision::read_ceiling(options.ceiling));
  auto drive = value_or_fail(vision::read_ceiling_drive(folder));
  constexpr std::size_t kOdometry = 2;  // column
  const auto odometry = value_or_fail(read_poses(folder / "poses.csv", kOdometry));
  const auto truth = value_or_fail(read_poses(folder / "truth" / "poses.csv", kOdometry));
  if (odometry.size() != drive.bytes.size() || truth.size() != drive.bytes.size())
    value_or_fail(Result<void>{fail(folder.string() + ": not as many poses as pictures")});
  if (const auto& at = options.place; !at.empty())
    drive.camera.mount = modules::EyePlace{at[0], at[1], at[2], at[3], at[4], at[5]}.camera_mount();
  const auto& lens = drive.camera.lens.params();
  vision::CeilingLocalizer localizer{mosaic, drive.camera};
  std::string rows = "picture,start,way,said,p_wrong,correlation,error,turn\n";
  double way = 0.0;
  int start = 0;
  for (std::size_t i = 0; i < drive.bytes.size(); ++i) {
    const bool begins = i % static_cast<std::size_t>(options.restart) == 0;
    way = begins ? 0.0 : way + distance(truth[i].position(), truth[i - 1].position());
    if (begins) localizer.forget(), ++start;
    std::vector<std::uint8_t>& bytes = drive.bytes[i];
    if (options.is_mirrored) std::reverse(bytes.begin(), bytes.end());
    const auto fix = localizer.see({lens.columns, lens.rows, bytes}, odometry[i]);
    const double error = fix ? distance(fix->map_from_robot.position(), truth[i].position()) : -1.0;
    const double turn = fix ? std::abs((fix->map_from_robot.theta - truth[i].theta).degrees()) : -1.0;
    char row[160];
    std::snprintf(row, sizeof row, "%zu,%d,%.3f,%d,%.6f,%.3f,%.4f,%.3f\n", i, start, way, fix ? 1 : 0,
                  fix ? fix->p_wrong : 1.0, fix ? fix->correlation : 0.0, error, turn);
    rows += row;
  }
  value_or_fail(write_file_atomically(options.out, rows));
}

}  // namespace

void add_follow_ceiling_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("follow-ceiling", "Find and follow a robot by the ceiling alone, beside the truth");
  auto options = std::make_shared<FollowOptions>();
  command->add_option("ceiling", options->ceiling, "YAML file of docent map-ceiling")->required();
  command->add_option("drive", options->drive, "Folder of docent-lab take-pictures")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", options->out, "CSV file to write: what it said of each picture")
      ->required()
      ->check(output_file());
  command->add_option("--restart", options->restart, "Pictures after which it forgets where it is")
      ->check(CLI::Range(3, 1000000))
      ->capture_default_str();
  command
      ->add_option("--place", options->place,
                   "X,Y,Z,PAN,TILT,ROLL of the camera [m, deg] instead of what the drive says")
      ->delimiter(',')
      ->expected(6);
  command->add_flag("--upside-down", options->is_mirrored, "Every picture is turned by half a turn");
  command->footer("Example:\n  docent-lab follow-ceiling museums/bonn/ceiling.yaml build/drive --out ways.csv");
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::follow_ceiling_command
