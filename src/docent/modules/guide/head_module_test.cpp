#include "docent/modules/guide/head_module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/modules/shared/module_bench.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr double kRight = std::numbers::pi / 2.0;

/// The robot stands at (2, 3) in the map and looks to the north; its odometry began elsewhere. A clock hangs east of
/// it.
class HeadModuleTest : public ModuleBench {
 protected:
  HeadModuleTest() : ModuleBench{"head", make_head} {
    museum::Exhibit clock;
    clock.id = "clock";
    clock.look_at = {6.0, 3.0};
    museum.exhibits.push_back(clock);
    keep(topics::kExpression, expression, expressions);
    keep(topics::kHeadCommand, joints, joint_commands);
  }
  void publish_pose() {
    nav_msgs::Odometry odometry;
    odometry.header = {to_message(hub.now()), "odom"};
    odometry.pose.pose = to_message(odom_from_base);
    odometries.publish(odometry);
    docent_msgs::Belief belief;
    belief.header = {to_message(hub.now()), "map"};
    belief.localized = true;
    belief.hypotheses.push_back({2.0, 3.0, kRight, {}, 1.0});
    belief.odom_pose = to_message(odom_from_base);
    beliefs.publish(belief);
  }
  /// Lets time pass while the robot's other parts say, ten times a second, what the flags say.
  void live(double time_s) {
    for (int i = 0; i < static_cast<int>(std::lround(time_s * 10.0)); ++i) {
      if (has_pose) publish_pose();
      if (!people.people.empty()) people_in_odom.publish(people);
      if (is_blocked) {
        docent_msgs::AvoidState hindered;
        hindered.path_blocked = true;
        hindered.unmapped_obstacle = true;
        hindered.low_obstacle = is_thing;
        avoid.publish(hindered);
      }
      if (wanted_in_base) {
        docent_msgs::Gaze gaze;
        gaze.at = to_text(GazeAt::way);
        gaze.heading = (odom_from_base.theta + *wanted_in_base).radians();
        gazes.publish(gaze);
      }
      run(0.1);
    }
  }
  void set_task(const std::string& kind, const std::string& status) {
    docent_msgs::Task task;
    task.id = "t1";
    task.kind = kind;
    task.exhibit_id = kind == "visit" ? "clock" : "";
    tasks.publish(task);
    docent_msgs::TaskState report;
    report.id = "t1";
    report.state = status;
    task_states.publish(report);
  }
  void put_person(std::uint32_t id, Point2 in_base) {
    const Point2 in_odom = odom_from_base * in_base;
    people.people.push_back({id, static_cast<float>(in_odom.x), static_cast<float>(in_odom.y), 0.0F, 0.0F});
  }

  Pose2 odom_from_base{10.0, -4.0, Angle::degrees(30.0)};
  bool has_pose = true;
  bool is_blocked = false;
  bool is_thing = false;
  std::optional<Angle> wanted_in_base;
  docent_msgs::People people;
  docent_msgs::Expression expression;
  sensor_msgs::JointState joints;
  int expressions = 0;
  int joint_commands = 0;
  transport::Publisher<nav_msgs::Odometry> odometries = world->publisher(topics::kOdometry);
  transport::Publisher<docent_msgs::Belief> beliefs = world->publisher(topics::kBelief);
  transport::Publisher<docent_msgs::People> people_in_odom = world->publisher(topics::kPeopleInOdom);
  transport::Publisher<docent_msgs::AvoidState> avoid = world->publisher(topics::kAvoidState);
  transport::Publisher<docent_msgs::Reaction> reactions = world->publisher(topics::kReaction);
  transport::Publisher<docent_msgs::Gaze> gazes = world->publisher(topics::kGaze);
  transport::Publisher<docent_msgs::Task> tasks = world->publisher(topics::kTask);
  transport::Publisher<docent_msgs::TaskState> task_states = world->publisher(topics::kTaskState);
  transport::Publisher<docent_msgs::SpeechState> speech = world->publisher(topics::kSpeechState);
};

TEST_F(HeadModuleTest, SpeaksTenTimesASecondAlsoToAnEmptyHall) {
  start();
  live(2.0);
  EXPECT_NEAR(expressions, 20, 1);
  EXPECT_EQ(joint_commands, expressions);
  EXPECT_EQ(expression.header.frame_id, "base_link");
  EXPECT_EQ(expression.mood, "happy");
  EXPECT_EQ(expression.gaze, "none");
  EXPECT_EQ(expression.pan, 0.0);
  EXPECT_EQ(joints.name, (std::vector<std::string>{"head_pan_joint", "head_tilt_joint", "left_brow_joint",
                                                   "right_brow_joint", "mouth_joint", "jaw_joint"}));
  EXPECT_EQ(module->health().state, "ready");
}

TEST_F(HeadModuleTest, PointsAtTheExhibitWhileItDrivesAndTheJointsSayTheSame) {
  start();
  set_task("visit", "driving");
  live(5.0);
  EXPECT_EQ(expression.gaze, "goal");
  EXPECT_NEAR(expression.pan, -kRight, 0.02) << "east of a robot that looks north is to its right";
  EXPECT_LT(expression.tilt, 0.0);
  ASSERT_EQ(joints.position.size(), 6U);
  EXPECT_EQ(joints.position[0], expression.pan);
  EXPECT_EQ(joints.position[1], expression.tilt);
  EXPECT_GT(joints.position[4], 0.0) << "it smiles";
}

TEST_F(HeadModuleTest, LooksAtWhoeverBlocksItAndGetsAngryAndIsHappyAgain) {
  start();
  set_task("visit", "driving");
  wanted_in_base = Angle::degrees(20.0);
  live(3.0);
  EXPECT_EQ(expression.gaze, "goal");
  put_person(7, {1.4, 0.6});
  is_blocked = true;
  live(60.0);
  EXPECT_EQ(expression.gaze, "person");
  EXPECT_NEAR(expression.pan, std::atan2(0.6, 1.4), 0.02);
  EXPECT_EQ(expression.mood, "angry");
  EXPECT_LT(expression.valence, -0.9);
  people.people.clear();
  live(2.0);
  EXPECT_EQ(expression.gaze, "way") << "nobody is seen and yet something unmapped holds it up";
  EXPECT_NEAR(expression.pan, Angle::degrees(20.0).radians(), 0.05);
  is_blocked = false;
  live(60.0);
  EXPECT_EQ(expression.gaze, "goal");
  EXPECT_EQ(expression.mood, "happy");
  EXPECT_GT(expression.valence, 0.99);
}

TEST_F(HeadModuleTest, AThingMakesNobodyAngryAndTheLadderEndsABlockage) {
  start();
  set_task("home", "driving");
  wanted_in_base = Angle{};
  is_blocked = true;
  is_thing = true;
  live(60.0);
  EXPECT_EQ(expression.mood, "happy");
  is_thing = false;
  live(60.0);
  EXPECT_EQ(expression.mood, "angry");
  is_blocked = false;
  docent_msgs::Reaction ask;
  ask.step = "ask";
  reactions.publish(ask);
  live(0.5);
  EXPECT_EQ(expression.mood, "angry") << "who asks for way is blocked";
  docent_msgs::Reaction free;
  free.step = "free";
  reactions.publish(free);
  live(30.0);
  EXPECT_EQ(expression.mood, "happy");
}

TEST_F(HeadModuleTest, LooksAtVisitorsWhileItExplainsAndWhenItIsIdle) {
  start();
  put_person(3, {1.0, 1.0});
  live(3.0);
  EXPECT_EQ(expression.gaze, "visitor");
  EXPECT_NEAR(expression.pan, std::numbers::pi / 4.0, 0.02);
  set_task("visit", "explaining");
  live(1.0);
  EXPECT_EQ(expression.gaze, "visitor");
  people.people.clear();
  live(4.0);
  EXPECT_EQ(expression.gaze, "goal") << "silence for a second: whoever was there has gone, or `people` is dead";
  EXPECT_NEAR(expression.pan, -kRight, 0.02);
}

TEST_F(HeadModuleTest, TheMouthMovesWhileALineLastsAndClosesWithoutWord) {
  start();
  live(1.0);
  docent_msgs::SpeechState line;
  line.state = "speaking";
  line.start = to_message(hub.now());
  line.duration = 3.0;
  speech.publish(line);
  live(2.0);
  EXPECT_TRUE(expression.is_speaking);
  live(3.0);
  EXPECT_FALSE(expression.is_speaking) << "sound died in the middle";
}

TEST_F(HeadModuleTest, WithoutOdometryItLooksStraightOnAndSaysSo) {
  start();
  set_task("home", "driving");
  wanted_in_base = Angle::degrees(40.0);
  live(2.0);
  EXPECT_EQ(expression.gaze, "way");
  has_pose = false;
  live(4.0);
  EXPECT_EQ(expression.gaze, "none");
  EXPECT_NEAR(expression.pan, 0.0, 0.02);
  EXPECT_EQ(module->health().state, "degraded");
}

TEST_F(HeadModuleTest, TheSameSeedIsTheSameMoodAndSectionsAreChecked) {
  std::vector<double> first;
  for (int i = 0; i < 2; ++i) {
    hub.run_until(hub.now() + seconds(10.0));
    start();
    is_blocked = true;
    std::vector<double> valences;
    for (int k = 0; k < 200; ++k) {
      live(0.1);
      valences.push_back(expression.valence);
    }
    if (i == 0) first = valences;
    if (i == 1) {
      for (std::size_t k = 0; k < valences.size(); ++k) EXPECT_NEAR(valences[k], first[k], 1e-9);
    }
  }
  ASSERT_TRUE(config.set("head.mood.calm_s=0"));
  const auto bus = hub.connect("another head");
  const auto refused = make_head({*bus, museum, config, state, 1, true});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("head.mood.calm_s"), std::string::npos) << refused.error().message;
}

TEST_F(HeadModuleTest, WearsTheFaceThatShallAttractPeopleAndNoLonger) {
  start();
  docent_msgs::Task task;
  task.id = "m1";
  task.kind = "mingle";
  task.gaze = "ahead";
  task.face = "angry";
  task.speech = "demand";
  docent_msgs::TaskState report;
  report.id = "m1";
  report.state = "explaining";
  report.look = "company";
  put_person(7, {1.4, 0.6});
  tasks.publish(task);
  task_states.publish(report);
  live(4.0);
  EXPECT_EQ(expression.mood, "angry");
  EXPECT_LT(expression.valence, -0.9);
  EXPECT_EQ(expression.gaze, "none");
  report.state = "done";
  task_states.publish(report);
  live(4.0);
  EXPECT_EQ(expression.mood, "happy");
  EXPECT_EQ(expression.gaze, "visitor");
}

}  // namespace
}  // namespace docent::modules
