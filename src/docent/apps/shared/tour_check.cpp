#include "docent/apps/shared/tour_check.h"

#include <algorithm>

#include "docent/base/suggestion.h"
#include "docent/base/yaml.h"
#include "docent/task_control/golex/decomposition.h"
#include "docent/task_control/golog/golog_program.h"

namespace docent::apps {
namespace {

using task_control::Decomposition;
using task_control::GologAction;

std::vector<std::string> keys_of(const Decomposition& decomposition) {
  std::vector<std::string> keys;
  for (const auto& [key, items] : decomposition.actions) keys.push_back(key);
  return keys;
}

/// These two have no key of their own: the robot stands at its charger, or attracts people (`mingle`).
bool needs_no_key(const std::string& action) { return action == "charge_battery" || action == "wait_for_request"; }

void find_actions_without_key(const std::vector<GologAction>& actions, const Decomposition& decomposition,
                              const std::filesystem::path& file, std::vector<Error>& faults) {
  for (const GologAction& action : actions) {
    if (needs_no_key(action.name) || decomposition.find(action.name) != nullptr) continue;
    faults.push_back({action.place + ": no key of " + file.string() + " says what the robot does for the action '" +
                      action.name + "'" + did_you_mean(action.name, keys_of(decomposition))});
  }
}

void note_keys_without_action(const YamlFile& file, const std::vector<GologAction>& actions,
                              std::vector<std::string>& notes) {
  std::vector<std::string> known = keys_of(task_control::default_decomposition());
  for (const GologAction& action : actions) known.push_back(action.name);
  for (const auto& entry : file.root()) {
    const auto key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    notes.push_back(
        file.fault(entry.first, "note: no action is called '" + key + "'" + did_you_mean(key, known)).message);
  }
}

void note_languages(const YamlFile& file, const YAML::Node& texts, const std::vector<std::string>& languages,
                    std::vector<std::string>& notes) {
  for (const auto& text : texts) {
    const auto language = text.first.as<std::string>();
    if (std::find(languages.begin(), languages.end(), language) != languages.end()) continue;
    const std::string what = "note: the museum does not speak '" + language + "'" + did_you_mean(language, languages);
    notes.push_back(file.fault(text.first, what).message);
  }
  for (const std::string& language : languages) {
    if (!texts[language]) notes.push_back(file.fault(texts, "note: there is no text in '" + language + "'").message);
  }
}

}  // namespace

task_control::Programme programme_of(const museum::Museum& museum) {
  task_control::Programme programme;
  programme.home = museum.home;
  programme.charger = museum.charger;
  for (const museum::Exhibit& exhibit : museum.exhibits) programme.exhibits.push_back({exhibit.id, exhibit.pose, {}});
  return programme;
}

TourFindings check_tour(const std::filesystem::path& program, const museum::Museum& museum) {
  TourFindings findings;
  const task_control::Programme programme = programme_of(museum);
  findings.faults = task_control::GologProgram::faults(program, programme);
  const auto decomposition = task_control::load_decomposition(museum.folder);
  if (!decomposition) findings.faults.push_back(decomposition.error());
  if (!findings.faults.empty()) return findings;

  auto loaded = task_control::GologProgram::load({}, program, programme, task_control::straight_distance());
  const auto actions = loaded ? loaded->actions() : tl::unexpected(loaded.error());
  if (!actions) {
    findings.faults.push_back(actions.error());
    return findings;
  }
  const std::filesystem::path own = museum.folder / "golex.yaml";
  find_actions_without_key(*actions, *decomposition, own, findings.faults);
  const auto file = YamlFile::load(own);
  if (!file) return findings;  // there is none: load_decomposition has read it otherwise
  note_keys_without_action(*file, *actions, findings.notes);
  for (const auto& action : file->root()) {
    for (const auto& item : action.second) {
      for (const auto& directive : item) {
        if (directive.second.IsMap()) note_languages(*file, directive.second, museum.languages, findings.notes);
      }
    }
  }
  return findings;
}

}  // namespace docent::apps
