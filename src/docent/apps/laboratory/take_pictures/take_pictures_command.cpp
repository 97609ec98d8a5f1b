#include "docent/apps/laboratory/take_pictures/take_pictures_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/laboratory/take_pictures/drawn_hall.h"
#include "docent/apps/laboratory/take_pictures/picture_run.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"

namespace docent::apps::take_pictures_command {
namespace {

struct Options {
  std::string museum;
  HallOptions hall;
  std::string out;
  std::string ceiling;
  std::optional<std::uint64_t> ceiling_seed;
  std::vector<std::string> way;
  std::vector<std::string> kinds{"up", "front", "depth"};
  std::vector<int> dark;
  std::uint64_t drive_seed = 1;
  DriveOptions drive;
  PictureRunOptions run;
};

simulator::World world_of(const Options& options) {
  simulator::World world = options.museum.empty()
                               ? drawn_hall(options.hall)
                               : value_or_fail(simulator::load_world(options.museum + "/simulation.yaml"));
  if (options.ceiling_seed) world.ceiling_style.seed = options.ceiling_seed;
  for (const auto kind :
       {simulator::CeilingKind::various, simulator::CeilingKind::periodic, simulator::CeilingKind::plain})
    if (options.ceiling == simulator::to_string(kind)) world.ceiling_style.kind = kind;
  return world;
}

Drive drive_of(const Options& options, const simulator::World& world) {
  if (options.way.empty())
    return value_or_fail(drive_everywhere(world, options.drive, Rng{options.drive_seed}.stream("drive")));
  std::vector<Point2> way;
  for (const std::string& point : options.way) way.push_back(parse_point("--way", point));
  return value_or_fail(drive_along(way, options.drive));
}

void run(Options options) {
  const auto is_wanted = [&](const char* kind) {
    return std::find(options.kinds.begin(), options.kinds.end(), kind) != options.kinds.end();
  };
  options.run.up = is_wanted("up"), options.run.front = is_wanted("front"), options.run.depth = is_wanted("depth");
  for (const int circuit : options.dark) options.run.lighting.circuits[static_cast<std::size_t>(circuit)] = 0.0F;
  options.run.eyes.seed = options.run.seed;
  const simulator::World world = world_of(options);
  const Drive drive = drive_of(options, world);
  const std::size_t all = drive.pictures.size();
  const auto taken = [all](std::size_t count) {
    if (count % 100 == 0 || count == all) std::printf("%zu of %zu pictures\n", count, all), std::fflush(stdout);
  };
  value_or_fail(take_pictures(world, drive, options.run, options.out, taken));
  std::printf("%s: a drive of %.0f s\n", options.out.c_str(), drive.moments.back().time);
}

void add_drive(CLI::App& command, Options& options) {
  command.add_option("--pictures", options.drive.pictures, "So many at most")->capture_default_str();
  command
      .add_option("--way", options.way,
                  "X,Y of the points to drive along, straight, heeding nothing; without: everywhere")
      ->expected(2, 10'000);
  command.add_option("--spacing", options.drive.spacing, "[m] from picture to picture")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--lane", options.drive.lane, "[m] to where it was, where it drives everywhere")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--speed", options.drive.speed, "[m/s]")->check(CLI::Range(0.05, 3.0))->capture_default_str();
  add_seed(command, "--drive-seed", options.drive_seed, "Of where it drives after it was everywhere");
}

void add_cameras(CLI::App& command, Options& options) {
  command.add_option("--kinds", options.kinds, "Pictures of the camera that looks up, of the one in front, depths")
      ->check(CLI::IsMember({"up", "front", "depth"}))
      ->capture_default_str();
  command.add_option("--width", options.run.eyes.rig.width, "[pixels]")
      ->check(CLI::Range(64, 1920))
      ->capture_default_str();
  command.add_option("--height", options.run.eyes.rig.height, "[pixels]")
      ->check(CLI::Range(48, 1200))
      ->capture_default_str();
  command.add_flag("--fisheye", options.run.eyes.rig.fisheye, "The camera that looks up has a fisheye");
  add_seed(command, "--seed", options.run.seed, "Of errors of lenses and mounts, noise, rocking, exposure, odometry");
  command.add_option("--lean", options.run.eyes.lean, "[degrees] that the base rocks")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command.add_option("--exposure-steps", options.run.exposure_steps, "Chance of another exposure, a picture")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void add_overhead(CLI::App& command, Options& options) {
  command.add_option("--ceiling", options.ceiling, "Kind of ceiling instead of the museum's")
      ->check(CLI::IsMember({"various", "periodic", "plain"}));
  command.add_option("--ceiling-seed", options.ceiling_seed, "Of the ceiling, instead of the museum's");
  command.add_option("--dark", options.dark, "Circuits of lamps that are off, 0 to 7")->check(CLI::Range(0, 7));
  command.add_option("--daylight", options.run.lighting.daylight, "0 night .. 1 noon")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

}  // namespace

void add_take_pictures_command(CLI::App& app) {
  auto* command = app.add_subcommand("take-pictures", "What cameras see on a drive through an empty museum");
  auto options = std::make_shared<Options>();
  auto* museum = command->add_option("--museum", options->museum, "Museum folder; without: a hall is drawn")
                     ->check(CLI::ExistingDirectory);
  auto* hall = command->add_option_group("hall", "The hall that is drawn");
  hall->add_option("--hall-length", options->hall.length, "[m]")->check(CLI::Range(8.0, 200.0))->excludes(museum);
  hall->add_option("--hall-width", options->hall.width, "[m]")->check(CLI::Range(8.0, 200.0))->excludes(museum);
  hall->add_option("--hall-height", options->hall.height, "[m]")->check(CLI::Range(2.5, 20.0))->excludes(museum);
  hall->add_option("--opening", options->hall.opening, "[m] so much higher is the ceiling over its middle")
      ->check(CLI::Range(0.0, 40.0))
      ->excludes(museum);
  add_seed(*hall, "--hall-seed", options->hall.seed, "Of its columns, exhibits and ceiling");
  command->add_option("--out", options->out, "Folder to write")->required()->check(output_folder());
  add_drive(*command, *options);
  add_cameras(*command, *options);
  add_overhead(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::take_pictures_command
