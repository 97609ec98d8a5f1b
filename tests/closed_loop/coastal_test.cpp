#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "docent/apps/simulate/simulation_run.h"

// The whole robot drives coastal ways: with the weight that it takes, it goes round the open centre of the Smithsonian,
// without it straight through.

namespace docent {
namespace {

constexpr Point2 kCentre{32.5, 19.5};  // of the open floor, 20 m across
constexpr Point2 kTelephone{48.0, 12.4};
constexpr double kOpen = 5.0;  // [m] round it: far inside where a laser of 2.5 m sees nothing but people

struct Drive {
  double in_the_open = 0.0;  ///< [m] of its way
  double driven = 0.0;       ///< [m]
  nlohmann::ordered_json report;
};

Drive drive(const std::string& weight) {
  constexpr double kEnd =
      240.0;  // [s]: a robot is slow until it knows its mounts, and the open floor tells little of them
  const auto folder = std::filesystem::temp_directory_path() / ("docent-coastal-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream{folder / "scenario.yaml"} << "events:\n  - {at: 15, request: {target: telephone}}\n";
  apps::simulate_command::SimulationRunOptions options;
  options.museum = std::string{DOCENT_SOURCES} + "/museums/smithsonian";
  options.seed = 3;
  options.crowd = "empty";
  options.requests_per_hour = 0.0;
  options.start = Pose2{17.0, 22.0, Angle::degrees(-20.0)};
  options.settings = {"plan.coastal.weight=" + weight, "plan.coastal.places.range=2.5",
                      "plan.coastal.places.blocked=0.6"};
  options.scenario = (folder / "scenario.yaml").string();
  options.claims = (folder / "claims.csv").string();
  auto run = apps::simulate_command::SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << (run ? "" : run.error().message);
  if (!run) return {};
  EXPECT_TRUE((*run)->run_until(time_from_seconds(kEnd)).has_value());
  EXPECT_TRUE((*run)->finish().has_value());
  Drive result;
  result.report = nlohmann::ordered_json::parse((*run)->report_json());
  std::ifstream file{options.claims};
  std::string line;
  std::getline(file, line);
  std::optional<Point2> before;
  while (std::getline(file, line) && (!before || distance(*before, kTelephone) > 1.0)) {  // home lies in the open
    double time = 0.0;
    Point2 here{};  // the truth
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &here.x, &here.y), 3);
    const double step = before ? distance(*before, here) : 0.0;
    result.driven += step;
    if (distance(here, kCentre) < kOpen) result.in_the_open += step;
    before = here;
  }
  std::filesystem::remove_all(folder);
  return result;
}

TEST(Coastal, TheRobotGoesRoundTheOpenFloor) {
  const Drive shortest = drive("0");
  const Drive coastal = drive("0.2");
  EXPECT_GT(shortest.in_the_open, 5.0) << "the shortest way does not lead through the middle: nothing is tested";
  EXPECT_LT(coastal.in_the_open, 1.0);
  EXPECT_LT(coastal.driven, 2.0 * shortest.driven);
  for (const Drive* one : {&shortest, &coastal}) {
    EXPECT_EQ(one->report.at("exhibits_explained").get<int>(), 1);
    for (const auto& [what, count] : one->report.at("contacts").items()) EXPECT_EQ(count.get<int>(), 0) << what;
    EXPECT_EQ(one->report.at("area_violations").get<int>(), 0);
  }
}

}  // namespace
}  // namespace docent
