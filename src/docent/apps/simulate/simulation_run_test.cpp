#include "docent/apps/simulate/simulation_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "docent/apps/shared/deployment.h"
#include "docent/base/files.h"

namespace docent::apps::simulate_command {
namespace {

/// What the report of a world without a robot says of how that is crippled.
nlohmann::json crippled_in_report(const std::string& robot, const std::vector<std::string>& settings) {
  SimulationRunOptions options;
  options.museum = default_museum();
  options.crowd = "empty";
  options.has_robot = false;
  options.robot = robot;
  options.settings = settings;
  auto run = SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << run.error().message;
  EXPECT_TRUE((*run)->run_until(time_from_seconds(0.5)).has_value());
  return nlohmann::json::parse((*run)->report_json()).at("crippled");
}

TEST(SimulationRun, TheReportNamesWhatCripples) {
  using Json = nlohmann::json;
  EXPECT_EQ(crippled_in_report("", {}), Json::array());
  EXPECT_EQ(crippled_in_report("", {"evaluation.blind_to_people=yes"}), Json::array({"blind_to_people"}));
  const auto path = std::filesystem::temp_directory_path() / ("docent-crippled-" + std::to_string(getpid()) + ".yaml");
  ASSERT_TRUE(write_file_atomically(path, "evaluation: {dead_reckoning: on}\n").has_value());
  EXPECT_EQ(crippled_in_report(path, {"evaluation.without_watches=True"}),
            Json::array({"without_watches", "dead_reckoning"}));
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace docent::apps::simulate_command
