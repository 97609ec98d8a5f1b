#include "docent/apps/laboratory/crowd/crowd_command.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/laboratory/crowd/crowd_trial.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/base/files.h"

namespace docent::apps::crowd_command {
namespace {

constexpr std::size_t kStripEvery = 3;  // moments, one a second

struct Options {
  CrowdTrialOptions trial;
  std::string method;
  std::string report;
  std::string picture;
  std::string strip;
  bool trace = false;
  bool quiet = false;
};

/// The hall without people: how long it takes to cross it.
double empty_time(CrowdTrialOptions options) {
  options.density = 0.0;
  options.settle_s = 1.0;
  const auto outcome = value_or_fail(run_crowd_trial(options));
  if (!outcome.report.arrived) throw CommandFailed{"the robot does not even cross the empty hall"};
  return outcome.report.seconds;
}

std::string json_of(const Options& options, const CrowdTrialOutcome& outcome, double empty) {
  const auto rounded = [](double value) { return std::round(value * 1e4) / 1e4; };
  nlohmann::ordered_json json;
  json["seed"] = options.trial.seed;
  json["method"] = options.method;
  json["config_hash"] = outcome.config_hash;
  json["crippled"] = outcome.crippled;
  json["density"] = rounded(outcome.people / outcome.free_area);
  json["ignoring"] = options.trial.ignoring;
  json["people"] = outcome.people;
  json["free_area"] = rounded(outcome.free_area);
  json["walking"] = rounded(outcome.walking);
  json["empty_s"] = rounded(empty);
  json["limit_s"] = rounded(3.0 * empty + 60.0);
  json["horns"] = outcome.horns;
  json.update(nlohmann::ordered_json::parse(evaluation::to_json(outcome.report)));
  return json.dump(2) + "\n";
}

void print_trace(const CrowdTrialOutcome& outcome) {
  for (const auto& moment : outcome.moments)
    std::printf("%6.1f s  x %5.2f  y %5.2f  %4.0f deg  %.2f m/s  command %5.2f %5.2f  cap %.2f  free %.2f m  %s\n",
                moment.time, moment.robot.x, moment.robot.y, moment.robot.theta.degrees(), moment.speed,
                moment.avoid.linear, moment.avoid.angular, moment.avoid.speed_cap, moment.avoid.nearest_real_m,
                moment.avoid.reason.c_str());
}

void run(Options& options) {
  if (!(options.trial.density >= 0.0 && options.trial.density <= 3.0))
    throw CommandFailed{"--density must lie between 0 and 3 persons per m2", 2};
  if (!(options.trial.ignoring >= 0.0 && options.trial.ignoring <= 1.0))
    throw CommandFailed{"--ignoring must lie between 0 and 1", 2};
  options.trial.settings.insert(options.trial.settings.begin(), "avoid.method=" + options.method);
  const double empty = empty_time(options.trial);
  options.trial.limit_s = 3.0 * empty + 60.0;
  const auto outcome = value_or_fail(run_crowd_trial(options.trial));
  const evaluation::SocialReport& report = outcome.report;
  if (options.trace) print_trace(outcome);
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, json_of(options, outcome, empty)));
  if (!options.picture.empty()) value_or_fail(draw_crowd_trial(outcome).save(options.picture));
  if (!options.strip.empty()) value_or_fail(draw_crowd_strip(outcome, kStripEvery).save(options.strip));
  if (options.quiet) return;
  const auto people = report.contacts.find("people");
  std::printf(
      "seed %llu, %s: %d people on %.0f m2, %.0f %% walk; %s after %.1f s (empty %.1f, limit %.0f), %.1f m; "
      "%d contacts, %d bumps; within 0.45 m %.1f s, closing in %.1f s (between outlines %.1f s); %d horns\n",
      static_cast<unsigned long long>(options.trial.seed), options.method.c_str(), outcome.people, outcome.free_area,
      100.0 * outcome.walking, report.arrived ? "arrived" : "NOT arrived", report.seconds, empty, options.trial.limit_s,
      report.path_m, people == report.contacts.end() ? 0 : people->second, report.bumped_by_people, report.intimate_s,
      report.intimate_closing_s, report.near_closing_s, outcome.horns);
}

}  // namespace

void add_crowd_command(CLI::App& app, std::shared_ptr<RobotMaker> robot) {
  auto options = std::make_shared<Options>();
  options->trial.robot_maker = std::move(robot);
  options->method = "cautious_window";
  CLI::App* command = app.add_subcommand("crowd", "Cross a crowded hall once, scored after HuNavSim's definitions");
  add_seed(*command, "--seed", options->trial.seed, "of the hall, its crowd and the noise; same seed, same run");
  command->add_option("--density", options->trial.density, "persons a square metre of free floor")
      ->capture_default_str();
  command->add_option("--ignoring", options->trial.ignoring, "share of them who take no notice of the robot")
      ->capture_default_str();
  command->add_option("--method", options->method, "cautious_window, dynamic_window")
      ->check(CLI::IsMember({"cautious_window", "dynamic_window"}))
      ->capture_default_str();
  command->add_option("--set", options->trial.settings, "section.key=value over robot.yaml; may be repeated");
  command->add_option("--report", options->report, "JSON file for the score")->check(output_file());
  command->add_option("--picture", options->picture, "the way driven and the crowd at the end")
      ->check(output_picture());
  command->add_option("--strip", options->strip, "the hall every three seconds, with the way planned")
      ->check(output_picture());
  command->add_flag("--trace", options->trace, "print where it was every second, and why it was slow");
  command->add_flag("--quiet", options->quiet, "no summary");
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::crowd_command
