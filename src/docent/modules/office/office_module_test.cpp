#include "docent/modules/office/office_module.h"

#include "docent/messages/topics.h"
#include "docent/modules/shared/module_bench.h"

namespace docent::modules::office_module_test {
namespace {

/// A robot that stands in an empty hall of 6 x 6 m, and all the rest of it.
class OfficeTest : public ModuleBench {
 protected:
  OfficeTest() : ModuleBench{"office", make_office} {
    museum.languages = {"en"};
    museum.map = {{60, 60, 0.1, {0.0, 0.0}}, std::vector<std::int8_t>(3600, OccupancyGrid::kFree)};
    for (int i = 0; i < 60; ++i)
      for (const int k : {0, 59}) {
        museum.map.cells[museum.map.frame.index({i, k})] = OccupancyGrid::kOccupied;
        museum.map.cells[museum.map.frame.index({k, i})] = OccupancyGrid::kOccupied;
      }
    museum.area = {{0.2, 0.2}, {5.8, 0.2}, {5.8, 5.8}, {0.2, 5.8}};
    museum.home = {3.0, 3.0, {}};
    museum.rooms = {{"kitchen", {{"en", "Kitchen"}}, {3.0, 3.0}}};
    EXPECT_TRUE(config.set("office.enabled=true"));
    keep(topics::kRequest, request_, requests_count_);
    keep(topics::kOfficeState, state_, states_);
    keep(topics::kSay, said_, lines_);
  }
  /// A quarter of a second, in which the robot says where it is.
  void stand(double x, double y, int times = 1) {
    for (int i = 0; i < times; ++i) {
      docent_msgs::Belief belief;
      belief.header.stamp = to_message(hub.now());
      belief.localized = true;
      belief.odom_pose.orientation.w = 1.0;
      belief.hypotheses.resize(1);
      belief.hypotheses[0].x = x, belief.hypotheses[0].y = y;
      beliefs_.publish(belief);
      nav_msgs::Odometry odometry;
      odometry.header = {to_message(hub.now()), "odom"};
      odometry.pose.pose.orientation.w = 1.0;
      odometry_.publish(odometry);
      run(0.25);
    }
  }
  void order(const std::string& kind, const std::string& room = "") {
    orders_.publish({kind + room, kind, room, "staff"});
    run(0.3);
  }
  /// What became of the robot's last wish.
  void answer(const char* became, const char* reason = "") {
    docent_msgs::RequestBoard board;
    board.requests.push_back({request_, became, reason, {}, {}});
    boards_.publish(board);
    run(0.3);
  }
  void see(const std::string& object, double x, double y) {
    docent_msgs::SeenThings seen;
    seen.header.stamp = to_message(hub.now());
    seen.things.push_back({.id = 1, .object = object, .x = x, .y = y, .looks = 4, .known = 4, .last = {}});
    things_.publish(seen);
    run(0.1);
  }

  transport::Publisher<docent_msgs::Belief> beliefs_ = world->publisher(topics::kBelief);
  transport::Publisher<nav_msgs::Odometry> odometry_ = world->publisher(topics::kOdometry);
  transport::Publisher<docent_msgs::OfficeOrder> orders_ = world->publisher(topics::kOfficeOrder);
  transport::Publisher<docent_msgs::RequestBoard> boards_ = world->publisher(topics::kRequestBoard);
  transport::Publisher<docent_msgs::SeenThings> things_ = world->publisher(topics::kSeenThings);
  transport::Publisher<docent_msgs::Button> buttons_ = world->publisher(topics::kButton);
  docent_msgs::Request request_;
  docent_msgs::OfficeState state_;
  docent_msgs::Say said_;
  int requests_count_ = 0, states_ = 0, lines_ = 0;
};

TEST_F(OfficeTest, BringsSomethingToARoomByARequestOfTheStaff) {
  start();
  stand(1.0, 1.0, 4);
  order("deliver", "kitchen");
  EXPECT_EQ(request_.kind, "room");
  EXPECT_EQ(request_.target, "kitchen");
  EXPECT_EQ(request_.source, "staff");
  const std::string id = request_.id;
  run(4.2);
  EXPECT_EQ(requests_count_, 3) << "until it is on the board";
  EXPECT_EQ(request_.id, id);
  answer("active");
  run(4.2);
  EXPECT_EQ(requests_count_, 3);
  EXPECT_EQ(state_.phase, "driving");
  answer("fulfilled");
  EXPECT_EQ(state_.phase, "handing_over");
  EXPECT_NE(said_.text.find("Kitchen"), std::string::npos) << said_.text;
  buttons_.publish({{}, 4});
  run(0.3);
  EXPECT_EQ(state_.phase, "handing_over") << "another button";
  buttons_.publish({{}, 3});
  run(0.3);
  EXPECT_EQ(state_.phase, "done");
}

TEST_F(OfficeTest, SaysWhyItCannotGetThere) {
  start();
  order("deliver", "cellar");
  answer("refused", "no_such_room cellar");
  EXPECT_EQ(state_.phase, "failed");
  EXPECT_EQ(state_.reason, "no_such_room cellar");
}

TEST_F(OfficeTest, LooksForThingsPointsAtThemAndIsStopped) {
  start();
  stand(1.0, 1.0, 4);
  order("tidy");
  stand(1.0, 1.0, 8);
  EXPECT_EQ(state_.phase, "looking");
  EXPECT_EQ(request_.kind, "point");
  see("can", 3.0, 3.0);
  answer("fulfilled");
  for (int i = 0; i < 8; ++i) see("can", 3.0, 3.0), stand(1.0, 1.0);
  EXPECT_EQ(state_.phase, "approaching");
  answer("fulfilled");
  for (int i = 0; i < 16; ++i) see("can", 3.0, 3.0), stand(2.0, 3.0);
  EXPECT_EQ(state_.phase, "asking");
  EXPECT_TRUE(state_.points);
  EXPECT_NEAR(state_.x, 3.0, 1e-9);
  const int before = requests_count_;
  order("stop");
  EXPECT_EQ(state_.phase, "idle");
  EXPECT_EQ(requests_count_, before) << "nothing was wished for any more";
}

TEST_F(OfficeTest, WithoutAPictureItGivesUpAndSaysWhatIsMissing) {
  start();
  stand(1.0, 1.0, 4);
  order("tidy");
  stand(1.0, 1.0, 250);
  EXPECT_EQ(state_.phase, "failed");
  EXPECT_NE(state_.reason.find("no picture"), std::string::npos);
}

TEST_F(OfficeTest, AnOrderThatNobodyKnowsIsNamed) {
  start();
  order("sing");
  EXPECT_EQ(module->health().state, "degraded");
  EXPECT_NE(module->health().reason.find("sing"), std::string::npos);
}

}  // namespace
}  // namespace docent::modules::office_module_test
