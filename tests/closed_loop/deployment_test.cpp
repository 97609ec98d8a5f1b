#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "docent/apps/shared/temporary_folder.h"
#include "docent/apps/simulate/simulation_run.h"
#include "docent/base/files.h"

// The whole robot in a crowd, in virtual time.

namespace {
int waits_for_the_disk = 0;
}  // namespace

// In place of those of the system, for this program.
extern "C" int fsync(int /*file*/) {
  ++waits_for_the_disk;
  return 0;
}
extern "C" int fdatasync(int /*file*/) {
  ++waits_for_the_disk;
  return 0;
}

namespace docent {
namespace {

nlohmann::ordered_json report_of(const apps::simulate_command::SimulationRunOptions& options, double minutes) {
  auto run = apps::simulate_command::SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << (run ? "" : run.error().message);
  if (!run) return {};
  const auto done = (*run)->run_until(time_from_seconds(60.0 * minutes));
  EXPECT_TRUE(done.has_value()) << (done ? "" : done.error().message);
  EXPECT_TRUE((*run)->finish().has_value());
  return nlohmann::ordered_json::parse((*run)->report_json());
}

apps::simulate_command::SimulationRunOptions busy_bonn(std::uint64_t seed) {
  static const apps::TemporaryFolder cache;  // one for all runs: a robot without one takes a second to start
  apps::simulate_command::SimulationRunOptions options;
  options.cache = cache.path();
  options.museum = std::string{DOCENT_SOURCES} + "/museums/bonn";
  options.seed = seed;
  options.crowd = "busy";
  return options;
}

/// What of a report does not depend on how fast it was made.
std::string without_costs(nlohmann::ordered_json report) {
  for (const char* key : {"wall_seconds", "cpu_seconds", "speedup", "wall_speedup", "p99_ms"}) report.erase(key);
  return report.dump(1);
}

TEST(Deployment, TheSameSeedGivesTheSameReport) {
  const auto first = report_of(busy_bonn(11), 3.0);
  const auto second = report_of(busy_bonn(11), 3.0);
  ASSERT_GT(first.at("distance_m").get<double>(), 5.0) << "nothing is the same because it is idle";
  EXPECT_GT(first.at("cpu_seconds").get<double>(), 0.0);
  EXPECT_LT(first.at("cpu_seconds").get<double>(), 1.1 * first.at("wall_seconds").get<double>() + 0.5)
      << "one thread runs all";
  EXPECT_EQ(without_costs(first), without_costs(second));
}

TEST(Deployment, TheCacheChangesNothingButTheTimeOfTheStart) {
  const apps::TemporaryFolder cache;
  apps::simulate_command::SimulationRunOptions options = busy_bonn(11);
  options.cache.clear();
  const auto without = report_of(options, 2.0);
  ASSERT_GT(without.at("distance_m").get<double>(), 5.0) << "nothing is the same because it is idle";
  options.cache = cache.path();
  EXPECT_EQ(without_costs(report_of(options, 2.0)), without_costs(without)) << "the run that fills it";
  std::filesystem::directory_iterator files{cache.path()};
  ASSERT_NE(files, std::filesystem::directory_iterator{}) << "nothing was kept";
  const auto inode = [path = files->path()] {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
  };
  const auto kept = inode();
  EXPECT_EQ(without_costs(report_of(options, 2.0)), without_costs(without)) << "the run that uses it";
  EXPECT_EQ(inode(), kept) << "the table was made anew";
}

TEST(Deployment, NeverWaitsForTheDisk) {
  apps::simulate_command::SimulationRunOptions options = busy_bonn(11);
  options.start = Pose2{7.0, 2.05, Angle::degrees(90.0)};
  const auto run = apps::simulate_command::SimulationRun::create(options);
  ASSERT_TRUE(run.has_value()) << run.error().message;
  waits_for_the_disk = 0;
  ASSERT_TRUE((*run)->run_until(time_from_seconds(30.0)));
  const auto report = nlohmann::ordered_json::parse((*run)->report_json());
  EXPECT_FALSE(report.at("localization").at("localized_after_s").is_null()) << "there was a place to keep";
  EXPECT_EQ(waits_for_the_disk, 0);
}

TEST(Deployment, AnotherSeedGivesAnotherRun) {
  const auto first = report_of(busy_bonn(11), 1.0);
  const auto second = report_of(busy_bonn(12), 1.0);
  EXPECT_NE(first.at("distance_m"), second.at("distance_m"));
}

TEST(Deployment, OneScannerInFrontGivesATourInACrowd) {
  apps::simulate_command::SimulationRunOptions options = busy_bonn(2);
  options.robot = std::string{DOCENT_SOURCES} + "/robots/one-scanner.yaml";
  const auto report = report_of(options, 8.0);
  EXPECT_GT(report.at("distance_m").get<double>(), 50.0);
  EXPECT_GE(report.at("exhibits_explained").get<int>(), 1);
  for (const char* kind : {"people", "furniture", "walls", "hazards"})
    EXPECT_EQ(report.at("contacts").at(kind).get<int>(), 0) << kind;
  EXPECT_EQ(report.at("area_violations").get<int>(), 0);
}

/// A robot that lacks what the papers' robot has: a tour all the same, slower, and nothing touched. What drives by
/// sonars alone is in the slice of scripts/evaluate bases.
TEST(Deployment, ASmallBaseGivesToursToo) {
  apps::simulate_command::SimulationRunOptions options = busy_bonn(2);
  options.robot = std::string{DOCENT_SOURCES} + "/robots/turtlebot.yaml";
  const auto report = report_of(options, 6.0);
  EXPECT_GT(report.at("distance_m").get<double>(), 20.0);
  EXPECT_LT(report.at("max_speed_mps").get<double>(), 0.48);
  EXPECT_GE(report.at("exhibits_explained").get<int>(), 1);
  for (const char* kind : {"people", "furniture", "walls", "hazards"})
    EXPECT_EQ(report.at("contacts").at(kind).get<int>(), 0) << kind;
  EXPECT_EQ(report.at("area_violations").get<int>(), 0);
}

TEST(Deployment, ABatteryThatIsLowBesideTheChargerIsCharged) {
  apps::simulate_command::SimulationRunOptions options = busy_bonn(4711);
  options.crowd = "empty";
  options.requests_per_hour = 0.0;
  options.start = Pose2{7.0, 2.05, Angle::degrees(90)};  // nearer to the charger than what counts as at home
  options.settings = {"mission.battery_low=0.999", "mission.battery_full=1.0"};
  const auto log = std::filesystem::temp_directory_path() / ("docent-charge-" + std::to_string(::getpid()) + ".csv");
  options.event_log = log.string();
  auto run = apps::simulate_command::SimulationRun::create(options);
  ASSERT_TRUE(run.has_value());
  ASSERT_TRUE((*run)->run_until(time_from_seconds(40.0)));
  ASSERT_TRUE((*run)->finish());
  const std::string events = read_file(log).value();
  std::filesystem::remove(log);
  const auto arrived = events.find(",arrived,charge,");
  ASSERT_NE(arrived, std::string::npos) << events;
  EXPECT_NE(events.find(",battery_full,", arrived), std::string::npos) << events;
}

TEST(Deployment, KilledModulesComeBackAndTheTourGoesOn) {
  apps::simulate_command::SimulationRunOptions options = busy_bonn(5);
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
  apps::simulate_command::SimulationRunOptions options = busy_bonn(seed);
  options.crowd = "empty";
  options.requests_per_hour = 0.0;
  options.start = Pose2{7.0, 2.05, Angle::degrees(90.0)};
  options.scenario = std::string{DOCENT_SOURCES} + "/tests/closed_loop/" + scenario;
  options.event_log = testing::TempDir() + "stool_" + std::to_string(::getpid()) + ".csv";
  StoolRun result{report_of(options, 2.4)};
  std::ifstream log{options.event_log};
  EXPECT_TRUE(log.is_open());
  for (std::string line; std::getline(log, line);)
    result.asked += line.find(",asked_for_way,") != std::string::npos ? 1 : 0;
  std::filesystem::remove(options.event_log);
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
