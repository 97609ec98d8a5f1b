#include "docent/apps/museum/check_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/map_note.h"
#include "docent/apps/shared/tour_check.h"
#include "docent/base/yaml.h"
#include "docent/interaction/sound/sound_file.h"
#include "docent/interaction/speech/dictionary.h"
#include "docent/interaction/speech/repertoire.h"
#include "docent/modules/drive/plan_module.h"
#include "docent/museum/heading_notes.h"
#include "docent/museum/museum.h"
#include "docent/museum/museum_loading.h"
#include "docent/robot/body_notes.h"
#include "docent/simulator/world/world.h"
#include "docent/task_control/golog/golog_program.h"

namespace docent::apps::museum_command {
namespace {

/// What the museum and its simulation must agree on: ids. Nothing else is shared.
void check_simulation(const museum::Museum& museum, std::vector<Error>& faults) {
  auto world = simulator::load_world(*museum.simulation_path);
  if (!world) {
    faults.push_back(world.error());
    return;
  }
  const YamlFile file = value_or_fail(YamlFile::load(*museum.simulation_path));
  const YAML::Node& root = file.root();
  for (std::size_t i = 0; i < world->exhibits.size(); ++i) {
    const museum::Exhibit* exhibit = museum.find_exhibit(world->exhibits[i]);
    const YAML::Node at = root["exhibits"][i];
    if (exhibit == nullptr) faults.push_back(file.fault(at, "museum.yaml has no exhibit '" + world->exhibits[i] + "'"));
    if (exhibit != nullptr && exhibit->web_only) {
      faults.push_back(file.fault(at, "exhibit '" + exhibit->id + "' is for the Web only"));
    }
  }
  for (std::size_t i = 0; i < world->tours.size(); ++i) {
    if (museum.find_tour(world->tours[i]) != nullptr) continue;
    faults.push_back(file.fault(root["tours"][i], "museum.yaml has no tour '" + world->tours[i] + "'"));
  }
}

/// The museum's texts exist in each of its languages; the robot's own phrases may not.
void note_languages(const museum::Museum& museum) {
  for (const std::string& language : museum.languages) {
    if (interaction::dictionaries().contains(language)) continue;
    const YamlFile file = value_or_fail(YamlFile::load(museum.folder / "museum.yaml"));
    const YAML::Node& root = file.root();
    const std::string what =
        "note: the robot's own phrases do not exist in '" + language + "': it says them in English";
    std::printf("%s\n", file.fault(root["languages"], what).message.c_str());
  }
}

/// Recordings and music must be playable; a recording that replaces nothing is only told.
void check_sounds(const museum::Museum& museum, std::vector<Error>& faults) {
  const interaction::Recordings recordings{museum.folder, interaction::repertoire(museum)};
  for (Error& fault : recordings.faults()) faults.push_back(std::move(fault));
  for (const auto& stray : recordings.strays())
    std::printf("note: %s is a recording of nothing that the robot says\n", stray.string().c_str());
  if (!museum.sound.music) return;
  if (const auto music = interaction::sound_duration(*museum.sound.music); !music) faults.push_back(music.error());
}

/// The tour program, the museum's own or the shipped one, and golex.yaml.
void check_program(const museum::Museum& museum, std::vector<Error>& faults) {
  const TourFindings found = check_tour(task_control::golog_file(museum.folder), museum);
  for (const std::string& note : found.notes) std::printf("%s\n", note.c_str());
  faults.insert(faults.end(), found.faults.begin(), found.faults.end());
}

/// For whoever is to record: each file, whether it is there, and what is to be said in which mood.
void list_recordings(const museum::Museum& museum) {
  const auto lines = interaction::repertoire(museum);
  const interaction::Recordings recordings{museum.folder, lines};
  for (const interaction::RepertoireLine& entry : lines) {
    const interaction::SpokenLine& line = entry.line;
    const bool is_there = recordings.find(line.language, line.text) != nullptr;
    std::printf("content/audio/%s/%s\t%s\t%s\t%s\n", line.language.c_str(), entry.name.c_str(),
                is_there ? "recorded" : "spoken by the voice", to_text(line.mood), line.text.c_str());
  }
}

void check(const Deployment& deployment, bool lists_recordings) {
  const std::filesystem::path folder{deployment.museum};
  const robot::RobotConfig config = value_or_fail(deployment.load_config(), 2);
  for (const std::string& note : robot::body_notes(config.body())) std::fprintf(stderr, "note: %s\n", note.c_str());
  std::vector<Error> faults = museum::check_museum(folder, value_or_fail(modules::checked_robot_of_plan(config), 2));
  if (faults.empty()) {
    const museum::Museum museum =
        value_or_fail(museum::load_museum(folder, museum::Stage::complete, reading_of(folder)));
    if (museum.simulation_path) check_simulation(museum, faults);
    check_sounds(museum, faults);
    check_program(museum, faults);
    for (const std::string& note : museum::heading_notes(museum)) std::fprintf(stderr, "note: %s\n", note.c_str());
    if (faults.empty()) {
      note_languages(museum);
      if (lists_recordings) list_recordings(museum);
      const GridFrame& frame = museum.map.frame;
      std::printf("%s: fine. %zu exhibits (%zu sensible pairs), %zu hazards, %zu tours, map %.1f x %.1f m\n",
                  folder.string().c_str(), museum.exhibits.size(), museum::sensible_pairs(museum),
                  museum.hazards.size(), museum.tours.size(), frame.columns * frame.resolution,
                  frame.rows * frame.resolution);
      say_classes(museum.map_path.string(), museum.map, museum.map_notes);
      return;
    }
  }
  for (const Error& fault : faults) std::fprintf(stderr, "%s\n", fault.message.c_str());
  throw CommandFailed{folder.string() + ": " + std::to_string(faults.size()) +
                      (faults.size() == 1 ? " fault" : " faults")};
}

}  // namespace

void add_check_command(CLI::App& app) {
  auto* command = app.add_subcommand("check", "Check a museum; every fault is named with file and line");
  auto deployment = std::make_shared<Deployment>();
  command->add_option("museum", deployment->museum, "Folder with a museum.yaml")->required();
  command->add_option("--robot", deployment->robot, "robot.yaml of the robot that must fit; without it all defaults");
  command->add_option("--set", deployment->settings, "section.key=value, over robot.yaml; may be repeated")
      ->allow_extra_args(false);
  auto lists_recordings = std::make_shared<bool>(false);
  command->add_flag("--recordings", *lists_recordings,
                    "List all that the robot can say there: the file of its recording, its mood and its words");
  command->callback([deployment, lists_recordings] { check(*deployment, *lists_recordings); });
}

}  // namespace docent::apps::museum_command
