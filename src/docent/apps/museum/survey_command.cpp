#include "docent/apps/museum/survey_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/simulator/world/survey.h"
#include "docent/simulator/world/world_picture.h"

namespace docent::apps::museum_command {
namespace {

struct SurveyOptions {
  std::string world;
  std::string out;
  std::uint64_t seed = 1;
  bool pictures = false;
  std::string picture_format = "png";
};

void print_names(const char* what, const std::vector<std::string>& names) {
  std::printf("%s:", what);
  for (const auto& name : names) std::printf(" %s", name.c_str());
  std::printf("%s\n", names.empty() ? " none" : "");
}

void run(const SurveyOptions& options) {
  const auto world = value_or_fail(simulator::load_world(options.world));
  const auto survey = simulator::survey(world, {}, Rng{options.seed});
  const std::filesystem::path out{options.out};
  std::error_code code;
  std::filesystem::create_directories(out, code);
  if (code) throw CommandFailed{options.out + ": cannot be made: " + code.message()};
  value_or_fail(save_map(survey.map, out / "map"));
  value_or_fail(write_file_atomically(out / "hazards.yaml", simulator::to_yaml(survey.hazards)));
  std::printf("%s: %d x %d cells, %zu hazards (hazards.yaml is the block for museum.yaml)\n",
              (out / "map.yaml").c_str(), survey.map.frame.columns, survey.map.frame.rows, survey.hazards.size());
  print_names("drawn where they no longer stand", survey.moved);
  print_names("not on the map", survey.missing);
  if (!options.pictures) return;
  value_or_fail(simulator::draw_world(world).save(out / ("world." + options.picture_format)));
  value_or_fail(simulator::draw_survey(survey).save(out / ("survey." + options.picture_format)));
}

}  // namespace

void add_survey_command(CLI::App& app) {
  auto* command = app.add_subcommand("survey", "Draw the robot's map of a true world, with a survey's small errors");
  auto options = std::make_shared<SurveyOptions>();
  command->add_option("--world", options->world, "simulation.yaml")->required();
  command->add_option("--out", options->out, "Folder for map.yaml, map.pgm and hazards.yaml")
      ->check(output_folder())
      ->required();
  add_seed(*command, "--seed", options->seed, "Seed of the errors");
  command->add_flag("--pictures", options->pictures, "Also draw world.png and survey.png");
  add_picture_format(*command, options->picture_format);
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::museum_command
