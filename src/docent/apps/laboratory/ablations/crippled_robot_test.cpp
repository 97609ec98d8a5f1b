#include "docent/apps/laboratory/ablations/crippled_robot.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/collision_avoidance/avoider/avoider_params.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::ablations {
namespace {

TEST(CrippledRobot, ReadsItsSectionHoweverItIsWrittenAndNamesWhatIsCrippled) {
  for (const char* yes : {"yes", "true", "on", "True", "YES", "y"}) {
    robot::RobotConfig config;
    CrippledRobot robot;
    ASSERT_TRUE(config.set(std::string{"evaluation.blind_to_people="} + yes));
    ASSERT_TRUE(robot.read(config));
    EXPECT_EQ(robot.crippled(), "blind_to_people") << yes;
    EXPECT_TRUE(config.check_sections(robot.sections()));
    EXPECT_TRUE(config.section<collision_avoidance::AvoiderParams>("avoid")->blind_to_people) << yes;
    ASSERT_TRUE(config.set("evaluation.blind_to_people=off"));
    ASSERT_TRUE(robot.read(config));
    EXPECT_EQ(robot.crippled(), "") << "the last wins";
    EXPECT_FALSE(config.section<collision_avoidance::AvoiderParams>("avoid")->blind_to_people);
  }
}

TEST(CrippledRobot, RefusesWhatIsNoSwitch) {
  for (const char* bad : {"evaluation.blind_to_people=1", "evaluation.blind=yes"}) {
    robot::RobotConfig config;
    ASSERT_TRUE(config.set(bad));
    const auto read = CrippledRobot{}.read(config);
    ASSERT_FALSE(read) << bad;
    EXPECT_TRUE(read.error().message.starts_with(std::string{"--set "} + bad)) << read.error().message;
  }
}

TEST(CrippledRobot, ItsModulesAreOnAnAlteredBus) {
  const auto state = std::filesystem::temp_directory_path() / ("docent_crippled_" + std::to_string(getpid()));
  for (const bool is_crippled : {false, true}) {
    std::filesystem::remove_all(state);
    std::filesystem::create_directories(state);
    robot::RobotConfig config;
    ASSERT_TRUE(config.set(std::string{"evaluation.ignores_hazards="} + (is_crippled ? "on" : "off")));
    CrippledRobot robot;
    ASSERT_TRUE(robot.read(config));
    museum::Museum museum;
    museum.area = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}};
    transport::VirtualTimeHub hub;
    const auto hazards = robot.make(*modules::find_module("hazards"), hub.connect("hazards"), museum, config,
                                    {.state = state, .seed = 1, .virtual_time = true});
    ASSERT_TRUE(hazards) << hazards.error().message;
    const auto world = hub.connect("world");
    float nearest = 1e9F;
    world->subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [&nearest](const auto& scan) {
      for (const float range : scan.ranges) nearest = std::min(nearest, range / scan.range_max);
    });
    docent_msgs::Belief belief;
    belief.localized = true;
    belief.cell_size = 0.15F;
    belief.heading_step = 0.07F;
    belief.cells.push_back({1.0F, 2.0F, 0.0F, 1.0F});
    belief.hypotheses.push_back({1.0, 2.0, 0.0, {}, 1.0});
    world->publisher(topics::kBelief).publish(belief);
    hub.run_until(time_from_seconds(0.5));
    EXPECT_EQ(nearest < 1.0F, !is_crippled) << nearest;
    EXPECT_LE(nearest, 1.0F) << "it says something";
  }
  std::filesystem::remove_all(state);
}

}  // namespace
}  // namespace docent::apps::ablations
