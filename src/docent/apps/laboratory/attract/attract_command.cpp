#include "docent/apps/laboratory/attract/attract_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/laboratory/attract/attract_picture.h"
#include "docent/apps/laboratory/attract/attract_run.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"
#include "docent/robot/robot_config.h"

namespace docent::apps::attract_command {
namespace {

constexpr int kMostTrialsOfARun = 20000;

struct Options {
  AttractRunOptions run;
  std::shared_ptr<RobotMaker> robot;
  std::string taste = "friendly";
  std::vector<std::string> settings;
  std::string memory;
  std::string report;
  std::string picture;
  bool quiet = false;
};

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

nlohmann::ordered_json json_of(const interaction::StyleStatistics& statistics) {
  nlohmann::ordered_json styles = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < statistics.size(); ++i) {
    const interaction::RewardStatistic& style = statistics.at(i);
    styles.push_back({{"style", interaction::words_of(interaction::Style{}).at(i)},
                      {"phases", style.count},
                      {"mean", rounded(style.mean)},
                      {"half_width", style.half_width ? nlohmann::ordered_json(rounded(*style.half_width)) : nullptr}});
  }
  return styles;
}

std::string json_of(const Options& options, const robot::RobotConfig& config, const AttractRunOutcome& outcome) {
  interaction::TrialMemory trials;
  for (const AttractPhase& phase : outcome.phases) trials.push_back(phase.trial);
  const auto& crowds = options.run.learner.crowd;
  nlohmann::ordered_json json;
  json["seed"] = options.run.seed;
  json["taste"] = options.taste;
  json["liking"] = options.run.taste == CrowdTaste::neither ? 0.0 : options.run.liking;
  json["config_hash"] = config.hash();
  json["crippled"] = options.robot->crippled();
  json["phases"] = outcome.phases.size();
  json["claim"] = to_text(outcome.claim);
  json["claimed_after"] = outcome.claimed_after;
  json["difference"] = rounded(outcome.difference);
  json["friendly_at_end"] = rounded(outcome.friendly_at_end);
  json["last_reward"] = rounded(outcome.last_reward);
  json["styles"] = json_of(interaction::style_statistics(trials, std::nullopt, crowds));
  for (const auto crowd :
       {interaction::CrowdClass::quiet, interaction::CrowdClass::busy, interaction::CrowdClass::packed})
    json["crowds"][to_text(crowd)] = json_of(interaction::style_statistics(trials, crowd, crowds));
  return json.dump(2) + "\n";
}

void run(Options& options) {
  if (!(options.run.trials >= 1 && options.run.trials <= kMostTrialsOfARun))
    throw CommandFailed{"--trials must lie between 1 and " + std::to_string(kMostTrialsOfARun), 2};
  if (!(options.run.liking >= 0.0 && options.run.liking <= 5.0))
    throw CommandFailed{"--liking must lie between 0 and 5", 2};
  options.run.taste = *parse<CrowdTaste>(options.taste);
  robot::RobotConfig config;
  for (const std::string& setting : options.settings) value_or_fail(config.set(setting), 2);
  std::vector<std::string> sections = options.robot->sections();
  sections.emplace_back("attract");
  value_or_fail(config.check_sections(sections), 2);
  value_or_fail(options.robot->read(config), 2);
  options.run.learner = value_or_fail(config.section<interaction::AttractionParams>("attract"), 2);
  if (!options.memory.empty()) options.run.memory = value_or_fail(interaction::load_trials(options.memory));
  const AttractRunOutcome outcome = run_attract(options.run);
  if (!options.memory.empty()) value_or_fail(interaction::save_trials(options.memory, outcome.memory));
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, json_of(options, config, outcome)));
  if (!options.picture.empty())
    value_or_fail(draw_styles(outcome.memory, options.run.learner.crowd, to_text(outcome.claim)).save(options.picture));
  if (options.quiet) return;
  std::printf("seed %llu, people who like it %s: %zu phases, claim: %s",
              static_cast<unsigned long long>(options.run.seed), options.taste.c_str(), outcome.phases.size(),
              to_text(outcome.claim));
  if (outcome.claimed_after > 0) std::printf(" (after %d)", outcome.claimed_after);
  std::printf("; friendly minus upset %.2f standard deviations; of what it knows best at the end %.0f %% is friendly\n",
              outcome.difference, 100.0 * outcome.friendly_at_end);
}

}  // namespace

void add_attract_command(CLI::App& app, std::shared_ptr<RobotMaker> robot) {
  auto options = std::make_shared<Options>();
  options->robot = std::move(robot);
  CLI::App* command =
      app.add_subcommand("attract", "Learn to attract people, before a simulated crowd of unknown taste");
  add_seed(*command, "--seed", options->run.seed, "of the crowd and the learner; same seed, same run");
  command->add_option("--taste", options->taste, "what people like: friendly, upset, neither")
      ->check(CLI::IsMember({"friendly", "upset", "neither"}))
      ->capture_default_str();
  command
      ->add_option("--liking", options->run.liking,
                   "how much: a friendly robot stops exp(liking) as many as an even one")
      ->capture_default_str();
  command->add_option("--trials", options->run.trials, "phases of a minute")->capture_default_str();
  command
      ->add_option("--memory", options->memory,
                   "JSON file of phases that is read first, if it exists, and written at the end")
      ->check(output_file());
  command->add_option("--set", options->settings, "attract.key=value or evaluation.key=value; may be repeated");
  command->add_option("--report", options->report, "JSON file for claim and statistics")->check(output_file());
  command->add_option("--picture", options->picture, "mean reward by style, from friendly to upset")
      ->check(output_picture());
  command->add_flag("--quiet", options->quiet, "no summary");
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::attract_command
