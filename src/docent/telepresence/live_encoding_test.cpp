#include "docent/telepresence/live_encoding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

TEST(LiveEncoding, AFrameSaysWhereAndWhat) {
  LiveFrame frame;
  frame.now = time_from_seconds(12.5);
  frame.map_from_base = Pose2{1.23456, -2, Angle::radians(0.5)};
  frame.is_scan_in_map = true;
  frame.scan = {{1.0, 2.0}, {-0.125, 3.456}};
  frame.people.people = {{7, 1.5F, 2.5F, 0.1F, 0.0F}};
  frame.avoid = docent_msgs::AvoidState{};
  frame.avoid->reason = "person_in_way";
  frame.battery = 0.8;
  const Json json = Json::parse(encode_live(frame));
  EXPECT_EQ(json["t"], 12.5);
  EXPECT_EQ(json["pose"], Json({1.235, -2.0, 0.5}));
  EXPECT_EQ(json["scan"]["points"], Json({100, 200, -13, 346}));
  EXPECT_EQ(json["scan"]["frame"], "map");
  EXPECT_EQ(json["people"][0], Json({7, 1.5, 2.5, 0.1, 0.0}));
  EXPECT_EQ(json["avoid"]["reason"], Json({{"word", "person_in_way"}, {"about", ""}}));
  frame.avoid->reason = "no fresh sweep of the front laser";
  EXPECT_TRUE(Json::parse(encode_live(frame))["avoid"]["reason"].is_null()) << "for operators, in the health";
  EXPECT_EQ(json["battery"], 0.8);
}

TEST(LiveEncoding, NotKnowingIsSaid) {
  LiveFrame frame;
  frame.hypotheses = {{Pose2{1, 2, Angle{}}, 0.4}};
  const Json json = Json::parse(encode_live(frame));
  EXPECT_TRUE(json["pose"].is_null());
  EXPECT_EQ(json["hypotheses"][0], Json({1.0, 2.0, 0.0, 0.4}));
  EXPECT_EQ(json["scan"]["frame"], "base");
}

TEST(LiveEncoding, NonsenseStaysValidJson) {
  LiveFrame frame;
  frame.map_from_base = Pose2{NAN, INFINITY, Angle{}};
  EXPECT_TRUE(Json::accept(encode_live(frame)));
  docent_msgs::MissionState mission;
  mission.languages = {"en", "de"};
  mission.texts = {"broken \xff\xc3"};
  EXPECT_TRUE(Json::accept(encode_mission(mission)));
  EXPECT_TRUE(Json::accept(encode_belief({})));
  EXPECT_TRUE(Json::accept(encode_path({}, {})));
  EXPECT_TRUE(Json::accept(encode_window({})));
  EXPECT_TRUE(Json::accept(encode_refusal("x", {ReasonWord::gone, "\"\\\n\xff"})));
}

TEST(LiveEncoding, TheBoardHidesWholeIdsAndKeepsOpenRequests) {
  docent_msgs::RequestBoard board;
  for (int i = 0; i < 60; ++i) {
    docent_msgs::RequestState entry;
    entry.request.id = "018f3a6c-5b2e-7c3d-9a4b-0123456789" + std::to_string(10 + i);
    entry.request.target = "sputnik";
    entry.state = i < 50 ? "fulfilled" : i < 55 ? "queued" : "active";
    entry.changed = to_message(time_from_seconds(i));
    board.requests.push_back(entry);
  }
  const std::string text = encode_board(board);
  EXPECT_EQ(text.find("018f3a6c"), std::string::npos);
  const Json json = Json::parse(text);
  EXPECT_EQ(json["open"].size(), 10U);
  EXPECT_EQ(json["open"][0]["key"], "45678960");
  EXPECT_EQ(json["closed"].size(), 30U);
  EXPECT_EQ(json["closed"][0]["changed"], 49.0);  // the newest first
}

TEST(LiveEncoding, OnlyNamesOfAudioFilesBecomeAddresses) {
  docent_msgs::SpeechState speech;
  speech.audio = "00ff";
  EXPECT_EQ(Json::parse(encode_speech(speech))["audio"], "/audio/00ff.wav");
  speech.audio = "00ff.wav";
  EXPECT_EQ(Json::parse(encode_speech(speech))["audio"], "/audio/00ff.wav");
  speech.audio = "00ff.ogg";
  EXPECT_EQ(Json::parse(encode_speech(speech))["audio"], "/audio/00ff.ogg");
  for (const char* other : {"../00ff.wav", "00ff.txt", "00ff.ogg.wav"}) {
    speech.audio = other;
    EXPECT_EQ(Json::parse(encode_speech(speech))["audio"], "") << other;
    EXPECT_EQ(Json::parse(encode_sound({{}, 1.0, other, 0.5, {}}))["music"], "") << other;
  }
}

TEST(LiveEncoding, ASoundTellsHowLoudItIs) {
  const Json sound = Json::parse(encode_sound({{}, 0.5, "00ff.ogg", 0.125, to_message(time_from_seconds(12.5))}));
  EXPECT_EQ(sound["type"], "sound");
  EXPECT_EQ(sound["volume"], 0.5);
  EXPECT_EQ(sound["music"], "/audio/00ff.ogg");
  EXPECT_EQ(sound["music_volume"], 0.125);
  EXPECT_EQ(sound["start"], 12.5);
  EXPECT_EQ(Json::parse(encode_sound({{}, std::nan(""), "", 7.0, {}}))["volume"], 0.0) << "a browser refuses others";
  EXPECT_EQ(Json::parse(encode_sound({{}, std::nan(""), "", 7.0, {}}))["music_volume"], 1.0);
}

TEST(LiveEncoding, ASilentModuleIsNamed) {
  std::map<std::string, HealthEntry> modules;
  modules["avoid"].health.state = "ready";
  modules["avoid"].heard = time_from_seconds(10);
  EXPECT_EQ(Json::parse(encode_health(modules, 3, time_from_seconds(11)))["modules"][0]["state"], "ready");
  EXPECT_EQ(Json::parse(encode_health(modules, 3, time_from_seconds(13)))["modules"][0]["state"], "silent");
}

TEST(LiveEncoding, AFaceAtRestGivesTheSameText) {
  docent_msgs::Expression expression;
  expression.mood = "happy";
  expression.valence = 0.701;
  expression.pan = -0.302;
  const std::string text = encode_expression(expression);
  expression.header.stamp = to_message(time_from_seconds(3));
  expression.valence = 0.699;
  expression.pan = -0.298;
  EXPECT_EQ(encode_expression(expression), text);
  expression.pan = -0.26;
  EXPECT_NE(encode_expression(expression), text);
  expression.mood = "furious";
  expression.valence = -7;
  const Json json = Json::parse(encode_expression(expression));
  EXPECT_EQ(json["mood"], "neutral");
  EXPECT_EQ(json["valence"], -1.0);
}

TEST(LiveEncoding, ALongPathIsThinnedButKeepsItsEnd) {
  nav_msgs::Path path;
  path.poses.resize(3000);
  path.poses.back().pose.position.x = 42;
  const Json points = Json::parse(encode_path(path, {}))["points"];
  EXPECT_LE(points.size(), 802U);
  EXPECT_EQ(points[points.size() - 2], 42.0);
}

TEST(ScanPoints, AreInTheRobotsFrameAndValid) {
  sensor_msgs::LaserScan scan;
  scan.angle_min = 0;
  scan.angle_increment = 1.0F;
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges = {1.0F, 99.0F, NAN, 99.0F, 0.0F};
  const auto points = scan_points(scan, {0.5, 0, Angle::degrees(180)}, 2);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(points[0].x, -0.5, 1e-6);
  EXPECT_NEAR(points[0].y, 0.0, 1e-6);
}

}  // namespace
}  // namespace docent::telepresence
