#include "docent/recording/rosbag/topic_choice.h"

#include <gtest/gtest.h>

namespace docent::recording {
namespace {

using Names = std::vector<std::string>;

ChosenTopics chosen(const RecordedTopics& recorded, const WantedTopics& wanted = {}) {
  auto choice = choose_topics(recorded, wanted);
  EXPECT_TRUE(choice) << choice.error().message;
  return choice ? *choice : ChosenTopics{};
}
bool is_noted(const ChosenTopics& choice, const std::string& text) {
  for (const std::string& note : choice.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

TEST(TopicChoice, AnOrdinaryRobotLeavesNothingToSay) {
  const RecordedTopics recorded{.scans = {{"/scan_front", {100, "front", true}}, {"/scan_rear", {90, "rear", true}}},
                                .odometry = {{"/odom", {500, "odom"}}},
                                .transforms = {{"", 500}}};
  const ChosenTopics choice = chosen(recorded);
  EXPECT_EQ(choice.scans, (Names{"/scan_front", "/scan_rear"}));
  EXPECT_EQ(choice.odometry, "/odom");
  EXPECT_TRUE(choice.notes.empty()) << choice.notes.front();
}

TEST(TopicChoice, OfTwoRobotsOneIsUsedAndSaid) {
  RecordedTopics recorded{.scans = {{"/robot1/scan", {150, "laser", true}}, {"/robot2/scan", {400, "laser", false}}},
                          .odometry = {{"/robot1/odom", {600, "odom"}}}};
  const ChosenTopics choice = chosen(recorded);
  EXPECT_EQ(choice.scans, (Names{"/robot1/scan"}));
  EXPECT_EQ(choice.odometry, "/robot1/odom");
  EXPECT_TRUE(is_noted(choice, "/robot2/scan"));
  recorded.odometry["/robot2/odom"] = {600, "odom"};
  EXPECT_EQ(chosen(recorded).robot, "/robot2") << "more scans";
  for (const char* name : {"/robot1", "robot1", "/robot1/"}) {
    const ChosenTopics wanted = chosen(recorded, {.robot = name});
    EXPECT_EQ(wanted.scans, (Names{"/robot1/scan"}));
    EXPECT_EQ(wanted.odometry, "/robot1/odom");
    EXPECT_TRUE(wanted.notes.empty());
  }
  EXPECT_EQ(chosen(recorded, {.scans = {"/robot1/scan"}}).odometry, "/robot1/odom");
  const auto none = choose_topics(recorded, {.robot = "/robot3"});
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("/robot1, /robot2"), std::string::npos) << none.error().message;
}

TEST(TopicChoice, AScannerInANameSpaceOfItsOwnIsNoRobot) {
  const ChosenTopics choice =
      chosen({.scans = {{"/lidar/scan", {100, "laser", true}}}, .odometry = {{"/husky/wheels/odom", {500, "odom"}}}});
  EXPECT_EQ(choice.odometry, "/husky/wheels/odom");
  EXPECT_TRUE(choice.notes.empty());
}

TEST(TopicChoice, OfOneScannerTheRawScansAreTaken) {
  const ChosenTopics choice =
      chosen({.scans = {{"/scan", {100, "laser", true}}, {"/scan_filtered", {120, "laser", true}}},
              .odometry = {{"/odom", {9, "odom"}}}});
  EXPECT_EQ(choice.scans, (Names{"/scan"}));
  EXPECT_TRUE(is_noted(choice, "/scan_filtered"));
  const WantedTopics wanted{.scans = {"/scan_filtered"}};
  EXPECT_EQ(
      chosen({.scans = {{"/scan", {100, "laser", true}}, {"/scan_filtered", {120, "laser", true}}}}, wanted).scans,
      wanted.scans);
}

TEST(TopicChoice, AScannerWhosePlaceNobodySaysIsLeftWhereOthersHaveOne) {
  const ChosenTopics choice =
      chosen({.scans = {{"/camera/scan", {300, "camera_depth", false}}, {"/scan", {100, "laser", true}}}});
  EXPECT_EQ(choice.scans, (Names{"/scan"}));
  EXPECT_TRUE(is_noted(choice, "camera_depth"));
  EXPECT_EQ(chosen({.scans = {{"/a", {10, "a", false}}, {"/b", {20, "b", false}}}}).scans, (Names{"/b"}));
}

TEST(TopicChoice, GroundTruthIsNeverOdometry) {
  RecordedTopics recorded{.scans = {{"/scan", {100, "laser", true}}},
                          .odometry = {{"/ground_truth/state", {9000, "odom"}},
                                       {"/odometry/filtered", {3000, "odom"}},
                                       {"/odom", {500, "odom"}},
                                       {"/pose_in_map", {7000, "map"}}}};
  EXPECT_EQ(chosen(recorded).odometry, "/odom");
  EXPECT_TRUE(is_noted(chosen(recorded), "/odometry/filtered"));
  recorded.odometry.erase("/odom");
  EXPECT_EQ(chosen(recorded).odometry, "/odometry/filtered");
  EXPECT_TRUE(is_noted(chosen(recorded), "several sensors"));
  recorded.transforms[""] = 100;
  EXPECT_TRUE(chosen(recorded).is_by_transforms);
  recorded.transforms.clear();
  recorded.odometry.erase("/odometry/filtered");
  EXPECT_EQ(chosen(recorded).odometry, "");
  EXPECT_EQ(chosen(recorded, {.odometry = "/ground_truth/state"}).odometry, "/ground_truth/state");
  EXPECT_FALSE(choose_topics(recorded, {.odometry = "/odom"}));
  EXPECT_FALSE(choose_topics(recorded, {.scans = {"/scans"}}));
}

TEST(TopicChoice, RobotsWithoutNameSpacesAreToldApartByTheirFrames) {
  RecordedTopics recorded{.scans = {{"/scan1", {150, "robot1/laser", true}}, {"/scan2", {100, "robot2/laser", true}}},
                          .odometry = {{"/odom1", {500, "robot1/odom", "robot1/base_link"}},
                                       {"/odom2", {900, "robot2/odom", "robot2/base_link"}}}};
  EXPECT_EQ(chosen(recorded).scans, (Names{"/scan1"}));
  EXPECT_EQ(chosen(recorded).odometry, "/odom1") << "not the one with most messages";
  EXPECT_TRUE(is_noted(chosen(recorded), "several robots"));
  EXPECT_EQ(chosen(recorded, {.robot = "robot2"}).odometry, "/odom2");
  recorded.odometry.clear();
  recorded.transforms = {{"/robot1", 500}, {"/robot2", 900}};
  EXPECT_EQ(chosen(recorded).transforms, "/robot1");
  // One robot whose frames have a prefix, with odometry that has none.
  recorded = {.scans = {{"/scan", {9, "robot1/laser", true}}},
              .odometry = {{"/odom", {9, "odom", "base_link"}}},
              .transforms = {{"/robot1", 9}}};
  EXPECT_EQ(chosen(recorded).odometry, "/odom");
  EXPECT_FALSE(choose_topics(recorded, {.scans = {"/nothing"}}));
}

TEST(TopicChoice, ANameThatTellsOfWheelsWinsOverOneThatTellsNothing) {
  const RecordedTopics recorded{.scans = {{"/scan", {100, "laser", true}}},
                                .odometry = {{"/aligned", {9000, "odom"}}, {"/wheel_encoders", {500, "odom"}}}};
  EXPECT_EQ(chosen(recorded).odometry, "/wheel_encoders");
  EXPECT_TRUE(is_noted(chosen(recorded), "/aligned"));
}

}  // namespace
}  // namespace docent::recording
