#include "docent/apps/config/config_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "docent/apps/config/parameter_meanings.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/base/suggestion.h"
#include "docent/modules/host/process_class.h"
#include "docent/modules/host/registry.h"
#include "docent/robot/body_notes.h"
#include "docent/robot/parameter_list.h"

namespace docent::apps::config_command {

namespace {

constexpr std::size_t kCommentColumn = 34;  ///< where comments begin, if the value leaves room
constexpr const char* kBody = "body";

/// Every section: `body` first, then the modules' in the order of their names. Error: what is wrong in `config`.
Result<std::vector<robot::ParameterRows>> all_sections(const robot::RobotConfig& config) {
  std::vector<robot::ParameterRows> all;
  auto body = robot::list_parameters<robot::RobotBody>(config, kBody);
  if (!body) return tl::unexpected<Error>(body.error());
  all.push_back(std::move(*body));
  auto processes = robot::list_parameters<modules::ProcessParams>(config, modules::kProcesses);
  if (!processes) return tl::unexpected<Error>(processes.error());
  all.push_back(std::move(*processes));
  for (const modules::ModuleEntry& entry : modules::all_modules()) {
    auto rows = entry.parameters(config);
    if (!rows) return tl::unexpected<Error>(rows.error());
    all.push_back(std::move(*rows));
  }
  std::sort(all.begin() + 1, all.end(),
            [](const robot::ParameterRows& a, const robot::ParameterRows& b) { return a.front().key < b.front().key; });
  return all;
}

std::string meaning_of_row(const robot::ParameterRow& row) {
  std::string meaning = row.declared_in.empty() ? "" : meaning_of(row.declared_in, row.key);
  return meaning.empty() && !row.holds.empty() ? meaning_of_struct(row.holds) : meaning;
}

std::string line_of(const robot::ParameterRow& row) {
  std::string line(2 * static_cast<std::size_t>(row.depth), ' ');
  line += row.key + ":";
  if (row.holds.empty()) line += " " + row.value;
  const std::string meaning = meaning_of_row(row);
  if (meaning.empty()) return line;
  line.resize(std::max(line.size() + 2, kCommentColumn), ' ');
  return line + "# " + meaning;
}

}  // namespace

Result<std::string> commented_config(const robot::RobotConfig& config, const std::vector<std::string>& sections) {
  auto all = all_sections(config);
  if (!all) return tl::unexpected<Error>(all.error());
  const auto is_wanted = [&](const std::string& name) {
    return sections.empty() || std::find(sections.begin(), sections.end(), name) != sections.end();
  };
  for (const std::string& section : sections) {
    const bool is_known = std::any_of(all->begin(), all->end(),
                                      [&](const robot::ParameterRows& rows) { return rows.front().key == section; });
    if (is_known) continue;
    std::string known;
    std::vector<std::string> names;
    for (const robot::ParameterRows& rows : *all) {
      names.push_back(rows.front().key);
      known += (known.empty() ? "" : ", ") + names.back();
    }
    return fail("unknown section '" + section + "'" + did_you_mean(section, names) + " (known: " + known + ")");
  }
  std::string text = "# robot.yaml: a section a module; what is left out keeps the value that stands here.\n";
  for (const robot::ParameterRows& rows : *all) {
    if (!is_wanted(rows.front().key)) continue;
    text += "\n";
    for (const robot::ParameterRow& row : rows) text += line_of(row) + "\n";
  }
  return text;
}

std::vector<std::string> keys_without_meaning(const robot::RobotConfig& config) {
  std::vector<std::string> result;
  const auto all = all_sections(config);
  if (!all) return {all.error().message};
  for (const robot::ParameterRows& rows : *all) {
    std::vector<std::string> path;
    for (const robot::ParameterRow& row : rows) {
      path.resize(static_cast<std::size_t>(row.depth));
      path.push_back(row.key);
      if (!meaning_of_row(row).empty()) continue;
      std::string name;
      for (const std::string& part : path) name += (name.empty() ? "" : ".") + part;
      result.push_back(name);
    }
  }
  return result;
}

void add_config_command(CLI::App& app) {
  struct Options {
    Deployment deployment;
    std::vector<std::string> sections;
  };
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("config", "Print a robot.yaml with every parameter, its unit and its meaning");
  command->add_option("section", options->sections, "Sections to print: body, avoid, localize, …; without any, all");
  command->add_option("--robot", options->deployment.robot,
                      "robot.yaml whose values are shown instead of the defaults");
  command->add_option("--set", options->deployment.settings, "section.key=value, over robot.yaml; may be repeated")
      ->allow_extra_args(false);
  command->callback([options] {
    const robot::RobotConfig config = value_or_fail(options->deployment.load_config(), 2);
    for (const std::string& note : robot::body_notes(config.body())) std::fprintf(stderr, "note: %s\n", note.c_str());
    std::fputs(value_or_fail(commented_config(config, options->sections), 2).c_str(), stdout);
  });
}

}  // namespace docent::apps::config_command
