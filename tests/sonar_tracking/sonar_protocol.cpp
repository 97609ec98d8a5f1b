#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "sonar_trial.h"

namespace {

nlohmann::json to_json(const docent::SonarTrialOptions& options, const docent::SonarTrialResult& result) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const auto& tally = result.tally;
  return {{"seed", options.seed},
          {"minutes", options.minutes},
          {"floor_m2", result.floor_area},
          {"distance_m", result.drive.metres},
          {"moving_share", result.drive.moving_share},
          {"max_speed_mps", result.drive.max_speed},
          {"goals", result.drive.goals},
          {"contacts", result.drive.contacts},
          {"pings",
           {{"none", result.drive.kinds[0]},
            {"direct", result.drive.kinds[1]},
            {"bounced", result.drive.kinds[2]},
            {"cross_talk", result.drive.kinds[3]}}},
          {"mean_error_m", result.mean_error},
          {"p95_error_m", result.p95_error},
          {"max_error_m", result.max_error},
          {"mean_heading_error_deg", result.mean_turn * kDegrees},
          {"p95_heading_error_deg", result.p95_turn * kDegrees},
          {"within_three_deviations", result.within_three},
          {"sweeps",
           {{"matched", tally.matched},
            {"too_few", tally.too_few},
            {"unlike", tally.unlike},
            {"ambiguous", tally.ambiguous},
            {"too_far", tally.too_far}}},
          {"walls", {{"used", tally.walls}, {"refused", tally.walls_refused}}}};
}

}  // namespace

/// One seed of the protocol "sonar alone": prints or writes its report.
int main(int argc, char** argv) {
  CLI::App app{"A robot with sonars only drives through a generated office building"};
  docent::SonarTrialOptions options;
  std::string report;
  std::string trace;
  bool dead_reckoning = false;
  bool no_walls = false;
  bool no_matches = false;
  app.add_option("--seed", options.seed)->capture_default_str();
  app.add_option("--minutes", options.minutes)->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--max-speed", options.max_speed)->capture_default_str()->check(CLI::PositiveNumber);
  app.add_flag("--dead-reckoning", dead_reckoning, "Crippled: odometry alone");
  app.add_flag("--no-walls", no_walls, "Without the angles of walls");
  app.add_flag("--no-matches", no_matches, "Without matching sweeps to the map");
  app.add_option("--report", report, "JSON; without it, standard output");
  app.add_option("--trace", trace, "One line a sample: time, truth, error, deviations, tally");
  CLI11_PARSE(app, argc, argv);
  options.tracker.use_walls = !dead_reckoning && !no_walls;
  options.tracker.use_matches = !dead_reckoning && !no_matches;
  std::ofstream trace_file;
  if (!trace.empty()) trace_file.open(trace);
  const auto result = run_trial(options, trace.empty() ? nullptr : &trace_file);
  const std::string text = to_json(options, result).dump(1) + "\n";
  if (report.empty()) {
    std::cout << text;
    return 0;
  }
  std::ofstream file{report};
  file << text;
  file.close();
  if (file) return 0;
  std::cerr << report << ": cannot be written\n";
  return 2;
}
