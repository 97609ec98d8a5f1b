#include "docent/apps/museum/office_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/simulator/office/office.h"
#include "docent/simulator/world/world_picture.h"

namespace docent::apps::museum_command {
namespace {

struct OfficeOptions {
  std::string out;
  std::uint64_t seed = 1;
  bool pictures = false;
  std::string picture_format = "png";
};

void run(const OfficeOptions& options) {
  const std::filesystem::path out{options.out};
  const simulator::Office office = simulator::draw_office(options.seed);
  const simulator::Survey survey = simulator::survey(office.world, {}, Rng{options.seed}.stream("survey"));
  value_or_fail(simulator::write_museum(office, survey, out));
  std::printf("%s: %zu solids, %zu hazards, %zu pieces drawn where they no longer stand, %zu not on the map\n",
              (out / "museum.yaml").c_str(), office.world.solids.size(), survey.hazards.size(), survey.moved.size(),
              survey.missing.size());
  if (!options.pictures) return;
  value_or_fail(simulator::draw_world(office.world).save(out / ("world." + options.picture_format)));
  value_or_fail(simulator::draw_survey(survey).save(out / ("survey." + options.picture_format)));
}

}  // namespace

void add_office_command(CLI::App& app) {
  auto* command = app.add_subcommand("office", "Make a museum folder of an invented office building");
  auto options = std::make_shared<OfficeOptions>();
  command->add_option("--out", options->out, "Folder for museum.yaml, simulation.yaml, the map and texts")
      ->check(output_folder())
      ->required();
  add_seed(*command, "--seed", options->seed, "Seed of the building and of the survey's errors");
  command->add_flag("--pictures", options->pictures, "Also draw world.png and survey.png");
  add_picture_format(*command, options->picture_format);
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::museum_command
