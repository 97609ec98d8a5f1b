#include "docent/robot/robot_config.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <utility>

#include "docent/base/files.h"

namespace docent::robot {
namespace {

struct Speeds {
  double fast = 1.0;
  double slow = 0.1;
  template <class V>
  void visit(V& v) {
    v("fast", fast);
    v("slow", slow);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(slow <= fast)) return fail("slow must be <= fast");
    return {};
  }
};

RobotConfig config_of(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("docent-robot-" + std::to_string(getpid()) + ".yaml");
  EXPECT_TRUE(write_file_atomically(path, text).has_value());
  auto config = RobotConfig::load(path);
  std::filesystem::remove(path);
  EXPECT_TRUE(config.has_value()) << config.error().message;
  return std::move(*config);
}

TEST(RobotConfig, SettingsGoOverTheFileAndTheLastWins) {
  RobotConfig config = config_of("speeds:\n  slow: 0.5\nbody:\n  radius: 0.3\n");
  ASSERT_TRUE(config.set("speeds.fast=2").has_value());
  ASSERT_TRUE(config.set("speeds.fast=3").has_value());
  ASSERT_TRUE(config.set("body.radius=0.4").has_value());
  const auto speeds = config.section<Speeds>("speeds");
  ASSERT_TRUE(speeds.has_value()) << speeds.error().message;
  EXPECT_EQ(speeds->fast, 3.0);
  EXPECT_EQ(speeds->slow, 0.5);
  EXPECT_EQ(config.body().radius, 0.4);
  EXPECT_NE(config.hash(), config_of("speeds:\n  slow: 0.5\n").hash());
  EXPECT_TRUE(config.check_sections({"speeds"}).has_value());
  EXPECT_FALSE(config.check_sections({}).has_value());
}

struct Legs {
  Speeds speeds;
  int count = 2;
  template <class V>
  void visit(V& v) {
    v("speeds", speeds);
    v("count", count);
  }
  [[nodiscard]] Result<void> validate() const { return speeds.validate(); }
};

TEST(RobotConfig, SettingsReachThePartsOfASection) {
  RobotConfig config = config_of("legs:\n  speeds:\n    slow: 0.5\n");
  ASSERT_TRUE(config.set("legs.speeds.fast=2").has_value());
  ASSERT_TRUE(config.set("legs.count=4").has_value());
  const auto legs = config.section<Legs>("legs");
  ASSERT_TRUE(legs.has_value()) << legs.error().message;
  EXPECT_EQ(legs->speeds.fast, 2.0);
  EXPECT_EQ(legs->speeds.slow, 0.5);
  EXPECT_EQ(legs->count, 4);
  for (const char* bad : {"legs..fast=2", "legs.speeds.=2"}) EXPECT_FALSE(config.set(bad).has_value()) << bad;
}

TEST(RobotConfig, FaultsNameTheLineOfTheFileOrTheSetting) {
  RobotConfig config = config_of("# a comment\n\nspeeds:\n  slow: 0.5\n  medium: 0.7\n");
  ASSERT_TRUE(config.set("speeds.fast=2").has_value());
  const auto unknown = config.section<Speeds>("speeds");
  ASSERT_FALSE(unknown.has_value());
  EXPECT_NE(unknown.error().message.find(".yaml:5: "), std::string::npos) << unknown.error().message;

  RobotConfig slower = config_of("speeds:\n  slow: 0.5\n");
  ASSERT_TRUE(slower.set("speeds.fast=0.2").has_value());
  const auto invalid = slower.section<Speeds>("speeds");
  ASSERT_FALSE(invalid.has_value());
  EXPECT_EQ(invalid.error().message.find("--set speeds.fast=0.2:"), 0U) << invalid.error().message;

  for (const char* bad : {"speeds", "speeds=1", ".fast=1", "speeds.=1", "body.colour=red", "body.radius=wide",
                          "body.radius=[1", "body.radius"}) {
    EXPECT_FALSE(slower.set(bad).has_value()) << bad;
  }
  for (const char* bad : {"'a.b=1'", "\"a.b\"=1", "{a.b=1}", "a: {b.c=1", "speeds", "speeds.=1"}) {
    const auto refused = slower.set(bad);
    ASSERT_FALSE(refused.has_value()) << bad;
    EXPECT_EQ(refused.error().message, std::string{"--set "} + bad + ": expected section.key=value");
  }
  EXPECT_EQ(slower.body().radius, RobotBody{}.radius) << "a refused setting leaves nothing behind";
}

TEST(RobotConfig, ASectionCanBeRefusedWithItsFileAndLine) {
  const RobotConfig config = config_of("speeds: {}\n\nlegs:\n  count: 2\n");
  EXPECT_TRUE(config.refuse_section("wings", "is of birds").has_value());
  const auto refused = config.refuse_section("legs", "is of walkers");
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find(".yaml:4: section legs is of walkers"), std::string::npos)
      << refused.error().message;
  RobotConfig set;
  ASSERT_TRUE(set.set("legs.count=3").has_value());
  EXPECT_TRUE(set.refuse_section("legs", "is of walkers").error().message.starts_with("--set legs.count=3"));
  EXPECT_FALSE(set.check_sections({}).has_value());
}

TEST(RobotConfig, ASectionIsAmendedWhenItIsRead) {
  RobotConfig config = config_of("speeds: {fast: 0.9}\n");
  Amendments amendments;
  amendments.add<Speeds>([](Speeds& speeds) { speeds.fast *= 2.0; });
  config.set_amendments(std::move(amendments));
  const auto speeds = config.section<Speeds>("speeds");
  ASSERT_TRUE(speeds.has_value());
  EXPECT_DOUBLE_EQ(speeds->fast, 1.8);
  Speeds part;
  part.fast = 0.5;
  config.amend(part);
  EXPECT_DOUBLE_EQ(part.fast, 1.0);
}

TEST(RobotBody, TheRadiusHoldsTheOutlineWhichIsConvexRoundTheCentre) {
  const std::string outline = "body.outline=[[0.4, 0.25], [-0.5, 0.25], [-0.5, -0.25], [0.4, -0.25]]";
  RobotConfig config = config_of("body:\n  radius: 0.6\n");
  ASSERT_TRUE(config.set(outline).has_value());
  EXPECT_FALSE(config.set("body.radius=0.5").has_value()) << "two corners lie 0.56 m from the centre";
  for (const char* bad :
       {"[[0.4, 0.2], [-0.4, 0.2]]", "[[0.4, 0.2], [-0.4]]", "[[0.4, 0.2], [0.0, 0.1], [-0.4, 0.2], [0.0, -0.3]]",
        "[[0.4, 0.2], [0.1, 0.2], [0.1, -0.2], [0.4, -0.2]]", "[[0.4, 0.0], [-0.4, 0.2], [-0.4, 0.0]]",
        "[[.nan, 0.2], [-0.4, 0.2], [0.0, -0.3]]"}) {
    EXPECT_FALSE(config.set(std::string{"body.outline="} + bad).has_value()) << bad;
  }
  EXPECT_EQ(config.body().outline.size(), 4U);

  const auto path = std::filesystem::temp_directory_path() / ("docent-outline-" + std::to_string(getpid()) + ".yaml");
  ASSERT_TRUE(write_file_atomically(path, "# a comment\nbody:\n  outline: [[1, 1], [-1, 1], [0, -1]]\n").has_value());
  const auto small = RobotConfig::load(path);
  std::filesystem::remove(path);
  ASSERT_FALSE(small.has_value());
  EXPECT_NE(small.error().message.find(".yaml:3: body.radius"), std::string::npos) << small.error().message;
}

TEST(RobotBody, HasTheScannersThatItsConfigurationLists) {
  const RobotBody body;
  ASSERT_EQ(body.scanners.size(), 2U);
  EXPECT_EQ(body.scanners[0].frame, "laser_front");
  EXPECT_NEAR(std::abs(body.scanners[1].base_from_sensor().theta.degrees()), 180.0, 1e-9);

  const auto one = config_of("body:\n  scanners:\n    - {x: 0.2, field: 270}\n  sonars: 0\n  infrareds: 0\n");
  ASSERT_EQ(one.body().scanners.size(), 1U);
  EXPECT_EQ(one.body().scanners[0].name, "front");
  EXPECT_EQ(one.body().scanners[0].x, 0.2);
  EXPECT_EQ(one.body().scanners[0].field, 270.0);
  RobotConfig config;
  EXPECT_TRUE(config.set("body.scanners=[{name: left, frame: l, heading: 90}, {name: right, frame: r, heading: -90}]"));
  for (const char* bad :
       {"[{name: above}]", "[{}, {frame: other}]", "[{}, {name: rear}]", "[{frame: ''}]", "[{field: 0}]",
        "[{field: 361}]", "[{max_range: 0.1}]", "[{max_range: -4}]", "[{zero: far}]", "[{beams: 3}]", "[{rate: 0}]",
        "[{rate: .nan}]", "[{no_return: nan}]", "[{x: 3}]", "[{y: .nan}]", "[front]", "front"}) {
    EXPECT_FALSE(config.set(std::string{"body.scanners="} + bad).has_value()) << bad;
  }
}

TEST(RobotBody, HasScannersAsTheyAreSold) {
  RobotConfig config;
  ASSERT_TRUE(
      config.set("body.scanners=[{max_range: 80, upside_down: true, zero: nothing, beams: 2880, rate: 40, "
                 "clockwise: true, no_return: zero}]"));
  const Scanner& scanner = config.body().scanners[0];
  EXPECT_TRUE(scanner.upside_down && scanner.clockwise);
  EXPECT_EQ(scanner.max_range, 80.0);
  EXPECT_TRUE(config.set("body.posts=[[0.1, 0.1, 0.01]]"));
  for (const char* bad : {"[[0.1, 0.1]]", "[[0.3, 0.0, 0.01]]", "[[0.1, 0.1, 0.0]]", "[[.nan, 0.1, 0.01]]"})
    EXPECT_FALSE(config.set(std::string{"body.posts="} + bad).has_value()) << bad;
}

TEST(RobotBody, WithoutScannersItNeedsARingOfSonars) {
  RobotBody body;
  body.scanners.clear();
  EXPECT_TRUE(body.validate());
  for (const int sonars : {0, 8}) {
    body.sonars = sonars;
    EXPECT_FALSE(body.validate()) << sonars << " sonars: it would drive blind";
  }
}

TEST(RobotBody, KnowsItsSonarsByTheirFrames) {
  const RobotBody body;
  for (const int index : {0, 7, 10, 23}) EXPECT_EQ(body.sonar_of(RobotBody::sonar_frame(index)), index);
  EXPECT_EQ(RobotBody::sonar_frame(7), "sonar_07");
  for (const char* frame : {"", "sonar_", "sonar_24", "sonar_-1", "sonar_7x", "laser_front"})
    EXPECT_FALSE(body.sonar_of(frame)) << frame;
  EXPECT_EQ(body.infrared_of("infrared_09"), 9);
  EXPECT_EQ(RobotBody::infrared_frame(23), "infrared_23");
  EXPECT_FALSE(body.infrared_of("sonar_09"));
}

TEST(RobotConfig, AScannerSpeaksOnTheTopicThatIsSaid) {
  RobotConfig config;
  EXPECT_EQ(config.body().topic_of(config.body().scanners.at(1)), "scan_rear");
  const auto topic_of_first = [&](const std::string& scanners) {
    EXPECT_TRUE(config.set("body.scanners=[" + scanners + "]").has_value()) << scanners;
    return config.body().topic_of(config.body().scanners.at(0));
  };
  EXPECT_EQ(topic_of_first("{name: rear, frame: a}"), "scan") << "the only one";
  EXPECT_EQ(topic_of_first("{name: front, frame: a}, {name: rear, frame: b}"), "scan_front");
  EXPECT_EQ(topic_of_first("{name: front, frame: a, topic: lidar/scan_2}"), "lidar/scan_2");
  EXPECT_EQ(topic_of_first("{name: front, frame: a, topic: /scan}"), "/scan");
  for (const char* none : {"2d", "/", "a//b", "'a b'", "scan/", "a-b", "a/2"}) {
    EXPECT_FALSE(config.set(std::string{"body.scanners=[{name: front, frame: a, topic: "} + none + "}]").has_value())
        << none;
  }
}

TEST(RobotBody, TwoScannersDoNotSpeakOnOneTopic) {
  RobotBody body;
  Scanner front, rear;
  rear.name = "rear";
  rear.frame = "laser_rear";
  body.scanners = {front, rear};
  EXPECT_TRUE(body.validate());
  for (const auto& [of_front, of_rear] : {std::pair{"scan", "/scan"}, {"scan_rear", ""}, {"a/b", "a/b"}}) {
    body.scanners[0].topic = of_front;
    body.scanners[1].topic = of_rear;
    const auto valid = body.validate();
    ASSERT_FALSE(valid) << of_front;
    EXPECT_NE(valid.error().message.find("front and rear have one topic"), std::string::npos) << valid.error().message;
  }
  body.scanners[1].topic = "a/c";
  EXPECT_TRUE(body.validate());
}

TEST(RobotConfig, AMountIsSaidByAnyOfItsKeysElseByTheBase) {
  RobotConfig config;
  EXPECT_TRUE(config.body().scanners.at(0).has_mount);
  ASSERT_TRUE(config.set("body.scanners=[{name: front, frame: a}, {name: rear, frame: b, y: 0}]").has_value());
  EXPECT_FALSE(config.body().scanners.at(0).has_mount);
  EXPECT_TRUE(config.body().scanners.at(1).has_mount);
  ASSERT_TRUE(config.set("body.max_speed=0.5").has_value());
  EXPECT_FALSE(config.body().scanners.at(0).has_mount) << "what is said of other things changes nothing";
  config.set_mount(0, {0.1, -0.2, Angle::degrees(30.0)}, true);
  EXPECT_EQ(config.body().scanners.at(0).x, 0.1);
  EXPECT_NEAR(config.body().scanners.at(0).heading, 30.0, 1e-9);
  EXPECT_TRUE(config.body().scanners.at(0).upside_down);
}

}  // namespace
}  // namespace docent::robot
