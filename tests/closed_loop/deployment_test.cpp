#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "docent/apps/simulation_run.h"

// The whole robot in a crowd, in virtual time.

namespace docent {
namespace {

nlohmann::ordered_json report_of(const SimulationRunOptions& options, double minutes) {
  auto run = SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << (run ? "" : run.error().message);
  if (!run) return {};
  const auto done = (*run)->run_until(time_from_seconds(60.0 * minutes));
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
  return nlohmann::ordered_json::parse((*run)->report_json());
}

SimulationRunOptions busy_bonn(std::uint64_t seed) {
  SimulationRunOptions options;
  options.museum = std::string{DOCENT_SOURCES} + "/museums/bonn";
  options.seed = seed;
  options.crowd = "busy";
  return options;
}

TEST(Deployment, TheSameSeedGivesTheSameReport) {
  auto first = report_of(busy_bonn(11), 4.0);
  auto second = report_of(busy_bonn(11), 4.0);
  ASSERT_GT(first.at("distance_m").get<double>(), 5.0) << "nothing is the same because it is idle";
  EXPECT_GT(first.at("cpu_seconds").get<double>(), 0.0);
  EXPECT_LT(first.at("cpu_seconds").get<double>(), 1.1 * first.at("wall_seconds").get<double>() + 0.5)
      << "one thread runs all";
  for (const char* key : {"wall_seconds", "cpu_seconds", "speedup", "p99_ms"}) {
    first.erase(key);
    second.erase(key);
  }
  EXPECT_EQ(first.dump(1), second.dump(1));
}

TEST(Deployment, AnotherSeedGivesAnotherRun) {
  const auto first = report_of(busy_bonn(11), 1.0);
  const auto second = report_of(busy_bonn(12), 1.0);
  EXPECT_NE(first.at("distance_m"), second.at("distance_m"));
}

TEST(Deployment, KilledModulesComeBackAndTheTourGoesOn) {
  SimulationRunOptions options = busy_bonn(5);
  options.crowd = "quiet";
  options.scenario = std::string{DOCENT_SOURCES} + "/tests/closed_loop/kills.yaml";
  const auto report = report_of(options, 8.0);
  EXPECT_EQ(report.at("contacts").at("people").get<int>() + report.at("contacts").at("hazards").get<int>() +
                report.at("contacts").at("walls").get<int>() + report.at("contacts").at("furniture").get<int>(),
            0);
  EXPECT_EQ(report.at("area_violations").get<int>(), 0);
  EXPECT_GE(report.at("exhibits_explained").get<int>(), 2);
}

/// Some minutes in the empty Bonn with a stool in the way to the heart-lung machine, to which another way leads.
struct StoolRun {
  nlohmann::ordered_json report;
  int asked = 0;  ///< how often it asked to be let through
};
StoolRun run_with_stool(const std::string& scenario, std::uint64_t seed) {
  SimulationRunOptions options = busy_bonn(seed);
  options.crowd = "empty";
  options.requests_per_hour = 0.0;
  options.start = Pose2{7.0, 2.05, Angle::degrees(90.0)};
  options.scenario = std::string{DOCENT_SOURCES} + "/tests/closed_loop/" + scenario;
  options.event_log = testing::TempDir() + "stool_" + std::to_string(seed) + ".csv";
  StoolRun result{report_of(options, 2.4)};
  std::ifstream log{options.event_log};
  EXPECT_TRUE(log.is_open());
  for (std::string line; std::getline(log, line);)
    result.asked += line.find(",asked_for_way,") != std::string::npos ? 1 : 0;
  return result;
}

TEST(Deployment, TakesAnotherWayRoundWhatLiesBelowTheLasers) {
  for (const std::uint64_t seed : {3U, 4U}) {
    SCOPED_TRACE(seed);
    const StoolRun run = run_with_stool("stool_below_the_lasers.yaml", seed);
    EXPECT_EQ(run.report.at("exhibits_explained").get<int>(), 1);
    EXPECT_EQ(run.report.at("contacts").at("furniture").get<int>(), 0);
    EXPECT_LT(run.report.at("blocked").at("seconds").get<double>(), 15.0);
    EXPECT_EQ(run.asked, 0) << "nobody speaks to furniture";
  }
}

TEST(Deployment, RemembersWhatOnlyTouchFinds) {
  for (const std::uint64_t seed : {3U, 4U}) {
    SCOPED_TRACE(seed);
    const StoolRun run = run_with_stool("stool_below_all_sensors.yaml", seed);
    EXPECT_EQ(run.report.at("exhibits_explained").get<int>(), 1);
    const int touched = run.report.at("contacts").at("furniture").get<int>();
    EXPECT_GE(touched, 1) << "else the stool is not in the way";
    EXPECT_LE(touched, 2);
    EXPECT_EQ(run.asked, 0) << "nobody speaks to furniture";
  }
}

}  // namespace
}  // namespace docent
