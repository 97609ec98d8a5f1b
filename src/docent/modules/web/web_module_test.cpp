#include "docent/modules/web/web_module.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "docent/base/files.h"
#include "docent/interaction/sound/horn.h"
#include "docent/messages/conversions.h"
#include "docent/telepresence/server/screen_key.h"
#include "docent/telepresence/server/test_client.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

using Json = nlohmann::json;

const std::string kId = "018f3a6c-5b2e-7c3d-9a4b-0123456789ab";
const std::string kOtherId = "018f3a6c-5b2e-7c3d-9a4b-ba9876543210";

museum::Museum small_museum() {
  museum::Museum museum;
  museum.name = {{"en", "A hall"}};
  museum.languages = {"en"};
  museum.map.frame = {40, 30, 0.25, {0, 0}};
  museum.map.cells.assign(museum.map.frame.size(), OccupancyGrid::kFree);
  museum::Exhibit exhibit;
  exhibit.id = "sputnik";
  exhibit.title = {{"en", "Sputnik \"1\""}};
  exhibit.viewpoints = {{1, 1, Angle{}}, {2, 1, Angle{}}};
  museum.exhibits.push_back(exhibit);
  museum::Tour tour;
  tour.id = "space";
  tour.exhibits = {"sputnik"};
  museum.tours.push_back(tour);
  return museum;
}

/// The module on a bus of virtual time, with a browser at the other end of a real socket.
class WebModuleTest : public testing::Test {
 protected:
  void SetUp() override {
    state_ = std::filesystem::temp_directory_path() / ("docent-web-" + std::to_string(::getpid()) + "-" +
                                                       testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(state_);
    port_ = free_port();
    ASSERT_TRUE(config_.set("web.port=" + std::to_string(port_)));
    robot_bus_ = hub_.connect("robot");
    robot_bus_->subscribe<docent_msgs::Request>(topics::kRequest, [this](const auto& m) { requests_.push_back(m); });
    robot_bus_->subscribe<docent_msgs::ButtonLamps>(topics::kButtonLamps, [this](const auto& m) { lit_ = m.lit; });
    robot_bus_->subscribe<docent_msgs::Choice>(topics::kChoice, [this](const auto& m) { choices_.push_back(m); });
    start();
  }
  void TearDown() override {
    module_.reset();
    web_bus_.reset();
    std::filesystem::remove_all(state_);
  }
  static int free_port() {
    const int end = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(end, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::getsockname(end, reinterpret_cast<sockaddr*>(&address), &size), 0);
    ::close(end);
    return ntohs(address.sin_port);
  }
  void start() {
    web_bus_ = hub_.connect("web");
    auto module = make_web(context(*web_bus_));
    ASSERT_TRUE(module) << module.error().message;
    module_ = std::move(*module);
  }
  /// As a kill would do it, but for the process.
  void stop() {
    module_.reset();
    web_bus_.reset();
  }
  /// Says of itself that it is the robot's own screen.
  bool open_screen(telepresence::TestClient& screen, const std::string& key) {
    return screen.upgrade("", "/live?screen=" + key);
  }
  std::string screen_key() { return telepresence::screen_key(state_ / "screen.key").value(); }
  ModuleContext context(transport::Bus& bus) { return {bus, museum_, config_, state_, 1, true}; }

  void run(double seconds_of_bus) {
    const Time end = hub_.now() + seconds(seconds_of_bus);
    while (hub_.now() < end) hub_.run_until(std::min(end, hub_.now() + seconds(0.05)));
  }
  /// Lets the bus run until the viewer gets a message of this type.
  Json next(telepresence::TestClient& viewer, const std::string& type) {
    for (int i = 0; i < 2000; ++i) {
      hub_.run_until(hub_.now() + seconds(0.01));
      const auto frame = viewer.receive_frame(std::chrono::milliseconds{2});
      if (frame.opcode != 1) continue;
      Json json = Json::parse(frame.payload);
      if (json["type"] == type) return json;
    }
    ADD_FAILURE() << "no message of type " << type;
    return {};
  }
  static std::string request(const std::string& id, const std::string& target, int viewpoint = -1) {
    return Json{{"type", "request"},      {"id", id},       {"kind", "exhibit"}, {"target", target},
                {"viewpoint", viewpoint}, {"name", "Lise"}, {"language", "en"}}
        .dump();
  }
  void publish_board(const std::string& state) {
    docent_msgs::RequestBoard board;
    for (const auto& request : requests_) {
      if (request.kind == "cancel") continue;
      docent_msgs::RequestState entry;
      entry.request = request;
      entry.state = state;
      board.requests = {entry};
    }
    robot_bus_->publisher(topics::kRequestBoard).publish(board);
  }

  std::filesystem::path state_;
  int port_ = 0;
  transport::VirtualTimeHub hub_;
  museum::Museum museum_ = small_museum();
  robot::RobotConfig config_;
  std::vector<docent_msgs::Request> requests_;
  std::vector<docent_msgs::Choice> choices_;
  std::vector<std::int32_t> lit_{-1};
  std::unique_ptr<transport::Bus> robot_bus_;
  std::unique_ptr<transport::Bus> web_bus_;
  std::unique_ptr<Module> module_;
};

TEST_F(WebModuleTest, ARequestIsResentUntilItIsOnTheBoard) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  viewer.send_frame(request(kId, "sputnik", 1));
  EXPECT_EQ(next(viewer, "ack")["id"], kId);
  run(5.0);
  ASSERT_GE(requests_.size(), 4U);
  for (const auto& sent : requests_) {
    EXPECT_EQ(sent.id, kId);
    EXPECT_EQ(sent.source, "web");
    EXPECT_EQ(sent.visitor, "Lise");
    EXPECT_EQ(sent.target, "sputnik");
    EXPECT_EQ(sent.viewpoint, 1);
  }
  publish_board("queued");
  run(0.1);
  const std::size_t before = requests_.size();
  run(5.0);
  EXPECT_EQ(requests_.size(), before);
  // Said again after a reconnect: known, acknowledged, not sent for a second visit.
  viewer.send_frame(request(kId, "sputnik", 1));
  EXPECT_EQ(next(viewer, "ack")["id"], kId);
  run(5.0);
  EXPECT_EQ(requests_.size(), before + 1);  // once, in case the mission lost it
}

TEST_F(WebModuleTest, AnAcknowledgedRequestOutlivesTheModule) {
  {
    telepresence::TestClient viewer{port_};
    ASSERT_TRUE(viewer.upgrade());
    viewer.send_frame(request(kId, "sputnik"));
    next(viewer, "ack");
  }
  stop();
  requests_.clear();
  run(3.0);
  EXPECT_TRUE(requests_.empty());
  start();
  run(3.0);
  ASSERT_GE(requests_.size(), 2U);
  EXPECT_EQ(requests_.front().id, kId);
}

TEST_F(WebModuleTest, WhatTheMuseumDoesNotHaveIsRefused) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  viewer.send_frame(request(kId, "mona-lisa"));
  EXPECT_EQ(next(viewer, "refused")["reason"]["word"], "no_such_exhibit");
  viewer.send_frame(request(kId, "sputnik", 2));
  EXPECT_EQ(next(viewer, "refused")["reason"]["word"], "no_such_viewpoint");
  run(3.0);
  EXPECT_TRUE(requests_.empty());
}

TEST_F(WebModuleTest, ACancellationIsResentUntilItShows) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  viewer.send_frame(request(kId, "sputnik"));
  next(viewer, "ack");
  run(0.1);
  publish_board("queued");
  run(0.1);
  viewer.send_frame(Json{{"type", "cancel"}, {"id", kOtherId}, {"request", kId}}.dump());
  EXPECT_EQ(next(viewer, "ack")["id"], kOtherId);
  run(3.0);
  ASSERT_GE(requests_.size(), 3U);
  EXPECT_EQ(requests_.back().kind, "cancel");
  EXPECT_EQ(requests_.back().target, kId);
  publish_board("cancelled");
  run(0.1);
  const std::size_t before = requests_.size();
  run(3.0);
  EXPECT_EQ(requests_.size(), before);
}

TEST_F(WebModuleTest, OnlyAnOpenQuestionCanBeAnswered) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  const auto answer = [&](const std::string& prompt, const std::string& choice) {
    viewer.send_frame(Json{{"type", "choice"}, {"id", kId}, {"prompt", prompt}, {"choice", choice}}.dump());
  };
  answer("p1", "more");
  EXPECT_EQ(next(viewer, "refused")["reason"]["word"], "question_over");
  docent_msgs::MissionState mission;
  mission.prompt.id = "p1";
  mission.prompt.options = {"more", "next"};
  const auto missions = robot_bus_->publisher(topics::kMissionState);
  missions.publish(mission);
  EXPECT_EQ(next(viewer, "mission")["prompt"]["id"], "p1");
  answer("p1", "drive-faster");
  EXPECT_EQ(next(viewer, "refused")["reason"]["word"], "no_such_answer");
  answer("p1", "more");
  next(viewer, "ack");
  answer("p1", "next");  // too late: the first answer counts
  next(viewer, "ack");
  run(3.0);
  ASSERT_GE(choices_.size(), 2U);  // resent while the question is open
  for (const auto& choice : choices_) EXPECT_EQ(choice.choice, "more");
  mission.prompt = {};
  missions.publish(mission);
  run(1.1);
  const std::size_t before = choices_.size();
  run(3.0);
  EXPECT_EQ(choices_.size(), before);
}

TEST_F(WebModuleTest, ShowsThePoseOnceItIsKnown) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  EXPECT_TRUE(next(viewer, "live")["pose"].is_null());
  nav_msgs::Odometry odometry;
  odometry.header.stamp = to_message(hub_.now());
  odometry.pose.pose = to_message(Pose2{1, 0, Angle{}});
  robot_bus_->publisher(topics::kOdometry).publish(odometry);
  docent_msgs::Belief belief;
  belief.header.stamp = odometry.header.stamp;
  belief.localized = true;
  belief.hypotheses.resize(1);
  belief.hypotheses[0].x = 5.0;
  belief.hypotheses[0].y = 4.0;
  belief.hypotheses[0].mass = 1.0;
  belief.cells = {{5.0F, 4.0F, 0.0F, 1.0F}};
  belief.odom_pose = to_message(Pose2{});
  robot_bus_->publisher(topics::kBelief).publish(belief);
  EXPECT_EQ(next(viewer, "belief")["raster"]["cell"], 0.3);
  EXPECT_EQ(next(viewer, "live")["pose"], Json({6.0, 4.0, 0.0}));  // a metre further since the belief
}

TEST_F(WebModuleTest, ServesTheMuseum) {
  telepresence::TestClient client{port_};
  client.send("GET /api/museum.json HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto [head, body] = client.receive_reply();
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
  const Json museum = Json::parse(body);
  EXPECT_EQ(museum["exhibits"][0]["title"]["en"], "Sputnik \"1\"");
  EXPECT_EQ(museum["exhibits"][0]["viewpoints"].size(), 2U);
  EXPECT_EQ(museum["map"]["columns"], 40);
  client.send("GET /api/map.png HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(client.receive_reply().second.substr(1, 3), "PNG");
}

TEST_F(WebModuleTest, APortInUseIsOneClearLine) {
  const auto bus = hub_.connect("second");
  const auto second = make_web(context(*bus));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message,
            "web: 127.0.0.1:" + std::to_string(port_) + ": the port is in use by another program");
}

TEST_F(WebModuleTest, NonsenseInTheConfigurationIsNamed) {
  robot::RobotConfig config;
  ASSERT_TRUE(config.set("web.live_hz=0"));
  const auto bus = hub_.connect("second");
  const auto module = make_web({*bus, museum_, config, state_, 1, true});
  ASSERT_FALSE(module);
  EXPECT_NE(module.error().message.find("web.live_hz"), std::string::npos) << module.error().message;
}

TEST_F(WebModuleTest, TheHornIsToldWithTheNameOfItsSound) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  const auto horn = robot_bus_->publisher(topics::kHorn);
  horn.publish({});
  const Json loud = next(viewer, "horn");
  EXPECT_EQ(loud["audio"], "/audio/" + interaction::horn_sound().file);
  EXPECT_NEAR(loud["t"].get<double>(), to_seconds(hub_.now()), 0.5);
  EXPECT_NEAR(loud["duration"].get<double>(), interaction::horn_sound().duration_s, 0.01);
  ASSERT_TRUE(interaction::write_shared(interaction::horn_sound(), state_ / "audio"));  // as `sound` does
  telepresence::TestClient listener{port_};
  listener.send("GET " + loud["audio"].get<std::string>() + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(listener.receive_reply().second, interaction::horn_sound().content);

  const auto sound = robot_bus_->publisher(topics::kSoundState);
  sound.publish({{}, 0.0, "", 0.0, {}});
  horn.publish({});
  EXPECT_EQ(next(viewer, "horn")["audio"], "") << "muted";
}

TEST_F(WebModuleTest, ThePageIsToldWhatMusicPlaysAndHowLoud) {
  robot_bus_->publisher(topics::kSoundState).publish({{}, 0.8, "00ff.ogg", 0.2, to_message(time_from_seconds(1.0))});
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  const Json sound = next(viewer, "sound");
  EXPECT_EQ(sound["volume"], 0.8);
  EXPECT_EQ(sound["music"], "/audio/00ff.ogg");
  EXPECT_EQ(sound["music_volume"], 0.2);
  EXPECT_EQ(sound["start"], 1.0);
}

TEST_F(WebModuleTest, WhatTheScreenAsksForIsOfTheKiosk) {
  telepresence::TestClient screen{port_};
  ASSERT_TRUE(open_screen(screen, screen_key()));
  screen.send_frame(request(kId, "sputnik"));
  EXPECT_EQ(next(screen, "ack")["id"], kId);
  run(0.1);
  ASSERT_FALSE(requests_.empty());
  EXPECT_EQ(requests_.front().source, "kiosk");
  docent_msgs::MissionState mission;
  mission.prompt.id = "1-2/more";
  mission.prompt.options = {"more", "next"};
  robot_bus_->publisher(topics::kMissionState).publish(mission);
  next(screen, "mission");
  screen.send_frame(Json{{"type", "choice"}, {"id", kOtherId}, {"prompt", "1-2/more"}, {"choice", "more"}}.dump());
  EXPECT_EQ(next(screen, "ack")["id"], kOtherId);
  ASSERT_FALSE(choices_.empty());
  EXPECT_EQ(choices_.front().source, "kiosk");

  telepresence::TestClient stranger{port_};
  EXPECT_FALSE(open_screen(stranger, std::string(32, '0')));
}

TEST_F(WebModuleTest, TheScreenShowsPressesAndTheFace) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  const auto presses = robot_bus_->publisher(topics::kButton);
  presses.publish({{}, 7});  // no such button
  presses.publish({{}, 3});
  const Json press = next(viewer, "button");
  EXPECT_EQ(press["number"], 3);
  EXPECT_NEAR(press["t"].get<double>(), to_seconds(hub_.now()), 0.5);

  docent_msgs::Expression expression;
  expression.mood = "happy";
  expression.valence = 0.8;
  const auto faces = robot_bus_->publisher(topics::kExpression);
  faces.publish(expression);
  EXPECT_EQ(next(viewer, "expression")["valence"], 0.8);
  for (int i = 0; i < 20; ++i) faces.publish(expression);
  run(0.5);
  for (auto frame = viewer.receive_frame(std::chrono::milliseconds{50}); frame.opcode == 1;
       frame = viewer.receive_frame(std::chrono::milliseconds{50}))
    EXPECT_EQ(frame.payload.find("\"expression\""), std::string::npos) << "told again though nothing changed";
}

TEST_F(WebModuleTest, TheScreenGetsAnAnswerToWhatItAloneMayAsk) {
  telepresence::TestClient screen{port_};
  ASSERT_TRUE(open_screen(screen, screen_key()));
  screen.send_frame(R"({"type":"lamps","lit":[3,4]})");
  screen.send_frame(Json{{"type", "help"}, {"id", kId}, {"language", "de"}}.dump());
  EXPECT_EQ(next(screen, "refused")["reason"]["word"], "busy");
  EXPECT_EQ(lit_, (std::vector<std::int32_t>{3, 4}));
  screen.send_frame(
      Json{{"type", "answer"}, {"id", kOtherId}, {"question", "liked"}, {"answer", "yes"}, {"language", "en"}}.dump());
  EXPECT_EQ(next(screen, "ack")["id"], kOtherId);
  EXPECT_TRUE(read_file(state_ / "poll.csv").value().ends_with("en,liked,yes\n"));
  run(15.0);  // the screen says nothing any more
  EXPECT_EQ(lit_, std::vector<std::int32_t>{});
}

TEST_F(WebModuleTest, APictureOfAnExhibitIsServed) {
  stop();
  museum_.folder = state_;
  museum_.exhibits[0].picture = "sputnik.svg";
  ASSERT_TRUE(write_file_atomically(state_ / "sputnik.svg", "<svg/>"));
  start();
  telepresence::TestClient client{port_};
  client.send("GET /api/pictures/sputnik.svg HTTP/1.1\r\nHost: localhost\r\n\r\n");
  const auto [head, body] = client.receive_reply();
  EXPECT_NE(head.find("image/svg+xml"), std::string::npos) << head;
  EXPECT_EQ(body, "<svg/>");
  stop();
  std::filesystem::remove(state_ / "sputnik.svg");
  start();
  EXPECT_NE(module_->health().reason.find("sputnik.svg"), std::string::npos) << module_->health().reason;
}

TEST_F(WebModuleTest, AViewerHearsSomethingAtLeastEverySecond) {
  telepresence::TestClient viewer{port_};
  ASSERT_TRUE(viewer.upgrade());
  run(0.5);
  while (viewer.receive_frame(std::chrono::milliseconds{20}).opcode == 1) {
  }
  for (int second = 0; second < 3; ++second) {  // of a robot from which nothing comes at all
    run(1.0);
    EXPECT_EQ(viewer.receive_frame(std::chrono::milliseconds{500}).opcode, 1);
    while (viewer.receive_frame(std::chrono::milliseconds{20}).opcode == 1) {
    }
  }
}

}  // namespace
}  // namespace docent::modules
