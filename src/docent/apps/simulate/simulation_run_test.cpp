#include "docent/apps/simulate/simulation_run.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "docent/apps/shared/deployment.h"
#include "docent/base/files.h"

namespace docent::apps::simulate_command {
namespace {

/// A maker that reads a section and says that the robot is crippled as that says.
class LimpingRobot final : public RobotMaker {
 public:
  [[nodiscard]] std::vector<std::string> sections() const override { return {"evaluation"}; }
  [[nodiscard]] Result<void> read(robot::RobotConfig& config) override {
    const auto legs = config.section<Legs>("evaluation");
    if (!legs) return tl::unexpected<Error>(legs.error());
    limps_ = legs->limps;
    return {};
  }
  [[nodiscard]] std::string crippled() const override { return limps_ ? "limps" : ""; }

 private:
  struct Legs {
    bool limps = false;
    template <class V>
    void visit(V& v) {
      v("limps", limps);
    }
  };
  bool limps_ = false;
};

/// A run of a world without a robot.
SimulationRunOptions empty_world(const std::string& robot, const std::vector<std::string>& settings,
                                 std::shared_ptr<RobotMaker> maker) {
  SimulationRunOptions options;
  options.museum = default_museum();
  options.crowd = "empty";
  options.has_robot = false;
  options.robot = robot;
  options.settings = settings;
  options.robot_maker = std::move(maker);
  return options;
}

nlohmann::json crippled_in_report(const SimulationRunOptions& options) {
  auto run = SimulationRun::create(options);
  EXPECT_TRUE(run.has_value()) << run.error().message;
  EXPECT_TRUE((*run)->run_until(time_from_seconds(0.5)).has_value());
  return nlohmann::json::parse((*run)->report_json()).at("crippled");
}

TEST(SimulationRun, TheReportNamesWhatCripples) {
  using Json = nlohmann::json;
  const auto limping = std::make_shared<LimpingRobot>();
  EXPECT_EQ(crippled_in_report(empty_world("", {}, limping)), Json::array());
  EXPECT_EQ(crippled_in_report(empty_world("", {"evaluation.limps=yes"}, limping)), Json::array({"limps"}));
}

TEST(SimulationRun, AWholeRobotRefusesWhatCripples) {
  const auto whole = std::make_shared<RobotMaker>();
  EXPECT_EQ(crippled_in_report(empty_world("", {}, whole)), nlohmann::json::array());
  const auto set = SimulationRun::create(empty_world("", {"evaluation.limps=yes"}, whole));
  ASSERT_FALSE(set.has_value());
  EXPECT_NE(set.error().message.find("docent-lab"), std::string::npos) << set.error().message;
  const auto path = std::filesystem::temp_directory_path() / ("docent-crippled-" + std::to_string(getpid()) + ".yaml");
  ASSERT_TRUE(write_file_atomically(path, "plan: {}\nevaluation: {limps: on}\n").has_value());
  const auto in_file = SimulationRun::create(empty_world(path, {}, whole));
  std::filesystem::remove(path);
  ASSERT_FALSE(in_file.has_value());
  EXPECT_NE(in_file.error().message.find(".yaml:2: section evaluation cripples the robot"), std::string::npos)
      << in_file.error().message;
}

}  // namespace
}  // namespace docent::apps::simulate_command
