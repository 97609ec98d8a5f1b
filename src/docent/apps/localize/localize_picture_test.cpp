#include "docent/apps/localize/localize_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent::apps::localize_command {
namespace {

std::string svg_of(const pictures::Figure& figure) {
  const auto path = std::filesystem::temp_directory_path() / ("docent_run_" + std::to_string(getpid()) + ".svg");
  EXPECT_TRUE(figure.save(path));
  const auto svg = read_file(path);
  std::filesystem::remove(path);
  return svg ? *svg : "";
}

/// A robot that drives along a hall for 40 s.
class LocalizePicture : public testing::Test {
 protected:
  LocalizePicture() {
    map_.frame = {100, 40, 0.1, {0.0, 0.0}};
    map_.cells.assign(map_.frame.size(), OccupancyGrid::kFree);
    log_.max_range = 10.0;
    for (std::size_t i = 0; i <= 20; ++i) {
      recording::LoggedScan scan;
      scan.time = time_from_seconds(1000.0 + 2.0 * static_cast<double>(i));
      scan.bearing_step = 0.1;
      scan.ranges = {1.0F, 1.5F};
      log_.scans.push_back(scan);
      LoggedPose pose;
      pose.scan = i;
      pose.map_from_base = {1.0 + 0.4 * static_cast<double>(i), 2.0, {}};
      pose.has_pose = pose.localized = true;
      run_.poses.push_back(pose);
    }
  }
  OccupancyGrid map_;
  recording::LaserLog log_;
  LogRun run_;
};

TEST_F(LocalizePicture, TheRunHasItsTimesAndTheReferenceWhereThereIsOne) {
  const std::vector<std::optional<Pose2>> none(log_.scans.size());
  const std::string svg = svg_of(draw_run(map_, log_, run_, 5, none));
  for (const char* word : {"<title>Scans 0 to 20, 0 to 40 s</title>", "x [m], y [m], time [s]",
                           "trajectory while localized", "robot and scan"})
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  EXPECT_EQ(svg.find("reference"), std::string::npos);
  std::vector<std::optional<Pose2>> reference;
  for (const LoggedPose& pose : run_.poses) reference.emplace_back(pose.map_from_base);
  EXPECT_NE(svg_of(draw_run(map_, log_, run_, 5, reference)).find("reference trajectory"), std::string::npos);
}

TEST_F(LocalizePicture, AWayEndsWhereTheRobotIsCarriedOffAndWhereItDoesNotKnow) {
  for (std::size_t i = 0; i < log_.scans.size(); ++i) log_.scans[i].odom_from_base = run_.poses[i].map_from_base;
  EXPECT_EQ(ways_of(log_, run_, WayKind::kSaid).size(), 1U);
  EXPECT_TRUE(ways_of(log_, run_, WayKind::kUnsure).empty());
  for (std::size_t i = 8; i < 12; ++i) run_.poses[i].localized = false;
  for (std::size_t i = 15; i < run_.poses.size(); ++i) run_.poses[i].map_from_base.y += 1.5;  // the wheels do not turn
  const auto ways = ways_of(log_, run_, WayKind::kSaid);
  ASSERT_EQ(ways.size(), 3U);
  EXPECT_EQ(ways[0].size(), 8U);
  EXPECT_EQ(ways[1].size(), 3U);
  EXPECT_EQ(ways[2].size(), 6U);
  EXPECT_EQ(ways[2].front().y, 3.5);
  const auto unsure = ways_of(log_, run_, WayKind::kUnsure);
  ASSERT_EQ(unsure.size(), 1U);
  EXPECT_EQ(unsure[0].size(), 4U);

  // Where scans are rare, a long step is no jump: the wheels have turned.
  for (LoggedPose& pose : run_.poses) pose.localized = true;
  for (std::size_t i = 0; i < log_.scans.size(); ++i) log_.scans[i].odom_from_base = run_.poses[i].map_from_base;
  EXPECT_EQ(ways_of(log_, run_, WayKind::kSaid).size(), 1U);
}

TEST_F(LocalizePicture, HindsightIsToldFromWhatTheRobotSaid) {
  for (std::size_t i = 0; i < log_.scans.size(); ++i) log_.scans[i].odom_from_base = run_.poses[i].map_from_base;
  for (std::size_t i = 0; i < 10; ++i) {
    run_.poses[i].hindsight = run_.poses[i].map_from_base;
    run_.poses[i].localized = i >= 6;
    if (i >= 4 && i < 8) run_.poses[i].map_from_base.y += 1.0;  // it took another place for its own
  }
  const auto said = ways_of(log_, run_, WayKind::kSaid);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].size(), 13U);
  const auto hindsight = ways_of(log_, run_, WayKind::kHindsight);
  ASSERT_EQ(hindsight.size(), 1U);
  EXPECT_EQ(hindsight[0].size(), 8U);
  EXPECT_EQ(hindsight[0].back().y, 2.0);
  const auto taken_back = ways_of(log_, run_, WayKind::kTakenBack);
  ASSERT_EQ(taken_back.size(), 1U);
  ASSERT_EQ(taken_back[0].size(), 2U);
  EXPECT_EQ(taken_back[0].front().y, 3.0);
  const std::string svg = svg_of(draw_run(map_, log_, run_, 5, {}));
  for (const char* words : {"trajectory while localized", "trajectory known in hindsight", "taken back in hindsight"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
  EXPECT_EQ(svg.find("unsure"), std::string::npos);
}

TEST_F(LocalizePicture, AScanHasItsMoment) {
  const std::string svg = svg_of(draw_scan(map_, log_, run_.poses[7]));
  EXPECT_NE(svg.find("<title>scan 7, 14.0 s</title>"), std::string::npos);
  EXPECT_NE(svg.find("robot and scan, localized"), std::string::npos);
}

}  // namespace
}  // namespace docent::apps::localize_command
