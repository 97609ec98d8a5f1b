#include "docent/evaluation/run_logs/people_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>
#include <sstream>

#include "docent/base/files.h"
#include "docent/evaluation/people_match.h"
#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

docent_msgs::TruePerson true_person(std::uint32_t id, float x, float y) {
  docent_msgs::TruePerson person;
  person.id = id;
  person.x = x;
  person.y = y;
  person.radius = 0.25F;
  person.visible = true;
  return person;
}

docent_msgs::Person track(std::uint32_t id, float x, float y) {
  docent_msgs::Person person;
  person.id = id;
  person.x = x;
  person.y = y;
  return person;
}

TEST(PeopleMatch, NearestPairsFirstAndOneToOne) {
  docent_msgs::TrueState truth;
  truth.people = {true_person(1, 1.0F, 0.0F), true_person(2, 1.6F, 0.0F), true_person(3, 9.0F, 0.0F)};
  const std::vector<Point2> tracks{{1.25, 0.0}, {1.05, 0.0}, {8.4, 0.0}};
  const PeopleMatch match = match_people(truth, tracks);
  EXPECT_EQ(match.track_of[0], 1U);
  EXPECT_EQ(match.track_of[1], 0U) << "the nearer track is taken";
  EXPECT_EQ(match.track_of[2], std::nullopt) << "0.6 m off";
  EXPECT_EQ(match.person_of[2], std::nullopt);
}

TEST(PeopleMatch, BeamsWhereTheRecordingTells) {
  docent_msgs::TrueState truth;
  truth.people = {true_person(1, 1.0F, 0.0F), true_person(2, 2.0F, 0.0F)};
  truth.people[1].visible = false;
  EXPECT_EQ(beams_on(truth, 0), kVisibleBeams);
  EXPECT_EQ(beams_on(truth, 1), 0);
  truth.person_beams = {2, 9};
  EXPECT_EQ(beams_on(truth, 0), 2);
  EXPECT_EQ(beams_on(truth, 1), 9);
}

/// One second: a robot at (1, 1) that looks to the left, one person before it and a ghost.
std::vector<std::string> logged(bool in_map) {
  PeopleLog log;
  for (int i = 0; i <= 10; ++i) {
    const Time time = time_from_seconds(0.1 * i);
    auto truth = std::make_shared<docent_msgs::TrueState>();
    truth->header.stamp = to_message(time);
    truth->x = truth->y = 1.0;
    truth->theta = std::numbers::pi / 2.0;
    truth->people = {true_person(5, 1.0F, 3.0F), true_person(6, 30.0F, 3.0F)};
    truth->person_beams = {12, 0};
    auto people = std::make_shared<docent_msgs::People>();
    people->header.stamp = to_message(time);
    people->localized = in_map;
    if (in_map) {
      people->people = {track(41, 1.1F, 3.0F), track(42, 3.0F, 1.0F)};
    } else {  // odometry began where the robot stands: 2 m ahead is x = 2
      people->people = {track(41, 2.0F, -0.1F), track(42, 0.0F, -2.0F)};
    }
    log.add(transport::topic_info(in_map ? topics::kPeople : topics::kPeopleInOdom), time, people);
    log.add(transport::topic_info(topics::kTrueState), time, truth);
  }
  const auto path = std::filesystem::temp_directory_path() / ("docent-people-" + std::to_string(getpid()) + ".csv");
  EXPECT_TRUE(log.save(path.string()).has_value());
  std::istringstream text{read_file(path).value_or("")};
  std::filesystem::remove(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  EXPECT_EQ(lines.size(), log.rows() + 1);
  return lines;
}

TEST(PeopleLog, TwiceASecondOneRowAPersonAndOneAGhost) {
  const auto lines = logged(true);
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[1], "0.00,map,1,0.000,0.000,person,5,2.000,12,0.00,0.000,0.250,41,0.100,0.000,1.000,3.000");
  EXPECT_EQ(lines[2], "0.00,map,1,0.000,0.000,nobody,42,2.000,0,0.00,0.000,0.000,42,-1.000,0.000,3.000,1.000");
  EXPECT_EQ(lines[5].substr(0, 9), "1.00,map,");
}

TEST(PeopleLog, TracksInOdometrysFrameAreSeenFromTheTrueRobot) {
  const auto lines = logged(false);
  ASSERT_EQ(lines.size(), 7U);
  EXPECT_EQ(lines[1], "0.00,odom,0,0.000,0.000,person,5,2.000,12,0.00,0.000,0.250,41,0.100,0.000,1.000,3.000");
  EXPECT_NE(lines[2].find("nobody,42,2.000"), std::string::npos) << lines[2];
}

}  // namespace
}  // namespace docent::evaluation
