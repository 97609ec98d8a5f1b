#include "docent/telepresence/counting/count_desk.h"

#include <gtest/gtest.h>

#include "docent/messages/conversions.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {
namespace {

class CountDeskTest : public testing::Test {
 protected:
  CountDeskTest() {
    database_ = std::move(*Database::open(":memory:"));
    queue_ = std::make_unique<StoreQueue>(*database_, StoreQueue::Post{});
    desk_ = make("one");
    desks_ = {desk_.get()};
  }
  std::unique_ptr<CountDesk> make(const std::string& gateway) {
    return std::make_unique<CountDesk>(*queue_, std::move(*Statistics::open(*database_)), gateway, now_);
  }
  DayCount day(const std::string& mode = "open") {
    auto statistics = std::move(*Statistics::open(*database_));
    const auto days = *statistics->days("");
    for (const auto& day : days)
      if (day.mode == mode) return day;
    return {};
  }
  void run(double duration) { now_ = now_ + seconds(duration); }
  void drive(double duration, double speed) {
    for (int i = 0; i < static_cast<int>(duration * 10.0); ++i) {
      x_ += 0.1 * speed;
      nav_msgs::Odometry odometry;
      odometry.header.stamp = to_message(now_);
      odometry.pose.pose = to_message(Pose2{x_, 0.0, {}});
      odometry.twist.twist.linear.x = speed;
      desk_->see(odometry);
      run(0.1);
    }
  }
  void happens(EventKind kind) {
    docent_msgs::Event event;
    event.kind = to_text(kind);
    for (CountDesk* desk : desks_) desk->see(event);
  }
  docent_msgs::RequestState request(const std::string& id, RequestSource source, RequestStatus status,
                                    std::optional<Time> created = std::nullopt) {
    docent_msgs::RequestState entry;
    entry.request.id = id;
    entry.request.source = to_text(source);
    entry.state = to_text(status);
    entry.created = to_message(created.value_or(now_));
    entry.changed = to_message(created.value_or(now_));
    return entry;
  }

  Time now_ = time_from_seconds(1000.0);
  std::unique_ptr<Database> database_;
  std::unique_ptr<StoreQueue> queue_;
  std::unique_ptr<CountDesk> desk_;
  std::vector<CountDesk*> desks_;  ///< of all gateways
  double x_ = 0.0;
};

TEST_F(CountDeskTest, CountsTheDrive) {
  drive(10.0, 0.5);
  drive(5.0, 0.0);
  x_ += 50.0;  // the odometry jumps
  drive(10.0, 0.7);
  desk_->store("open", now_);
  const auto counts = day().counts;
  EXPECT_NEAR(counts.at(Counted::distance_m), 12.0, 0.2);
  EXPECT_NEAR(counts.at(Counted::travel_s), 20.0, 0.4);
  EXPECT_NEAR(counts.at(Counted::uptime_s), 25.0, 0.4);
  EXPECT_NEAR(counts.at(Counted::max_speed), 0.7, 1e-9);
}

TEST_F(CountDeskTest, CountsToursExhibitsAndThoseWhoStandRound) {
  docent_msgs::People people;
  people.people = {{1, 1.0F, 1.0F, 0.0F, 0.0F}, {2, 2.0F, 0.0F, 0.0F, 0.0F}, {3, 9.0F, 9.0F, 0.0F, 0.0F}};
  desk_->see_people(people, Pose2{});
  happens(EventKind::explained);
  desk_->see_people(people, std::nullopt);
  happens(EventKind::explained);
  happens(EventKind::tour_completed);
  happens(EventKind::point_reached);
  happens(EventKind::visit_failed);
  desk_->store("open", now_);
  const auto counts = day().counts;
  EXPECT_EQ(counts.at(Counted::exhibits), 2.0);
  EXPECT_EQ(counts.at(Counted::visitors), 2.0);
  EXPECT_EQ(counts.at(Counted::tours), 1.0);
  EXPECT_EQ(counts.at(Counted::points), 1.0);
}

TEST_F(CountDeskTest, CountsWhoFollowsATourAndHowOftenItsPlanChanges) {
  const auto people_near = [&](int count) {
    docent_msgs::People people;
    for (int i = 0; i < count; ++i) people.people.push_back({static_cast<std::uint32_t>(i), 1.0F, 1.0F, 0.0F, 0.0F});
    desk_->see_people(people, Pose2{});
  };
  const auto explains = [&](int followers) {
    people_near(followers);
    docent_msgs::Event event;
    event.kind = to_text(EventKind::explained);
    event.detail = "highlights";
    desk_->see(event);
  };
  happens(EventKind::tour_started);
  explains(5);
  happens(EventKind::plan_inserted);
  people_near(9);
  happens(EventKind::explained);  // put in for somebody else
  explains(4);
  happens(EventKind::plan_removed);
  explains(3);
  happens(EventKind::tour_completed);
  happens(EventKind::tour_started);
  explains(2);
  happens(EventKind::tour_broken_off);
  happens(EventKind::tour_failed);
  desk_->store("open", now_);
  const auto counts = day().counts;
  EXPECT_EQ(counts.at(Counted::first_stop), 7.0);
  EXPECT_EQ(counts.at(Counted::last_stop), 3.0);
  EXPECT_EQ(counts.at(Counted::plan_revisions), 2.0);
  EXPECT_EQ(counts.at(Counted::tours_broken), 1.0);
  EXPECT_EQ(counts.at(Counted::tours_failed), 1.0);
}

TEST_F(CountDeskTest, KeepsWhoStoodThereAtEachStopOfATour) {
  const auto explains = [&](const std::string& exhibit, int followers) {
    docent_msgs::People people;
    for (int i = 0; i < followers; ++i)
      people.people.push_back({static_cast<std::uint32_t>(i), 1.0F, 1.0F, 0.0F, 0.0F});
    desk_->see_people(people, Pose2{});
    docent_msgs::Event event;
    event.header.stamp = to_message(now_);
    event.kind = to_text(EventKind::explained);
    event.subject = exhibit;
    event.detail = "highlights";
    desk_->see(event);
  };
  const auto begins = [&] {
    docent_msgs::Event event;
    event.header.stamp = to_message(now_);
    event.kind = to_text(EventKind::tour_started);
    desk_->see(event);
  };
  begins();
  run(60.0);
  explains("zuse", 6);
  explains("airbus", 4);
  ASSERT_TRUE(database_->run_script("ALTER TABLE attendance RENAME TO elsewhere"));
  desk_->store("open", now_);
  EXPECT_NE(desk_->fault(), "");
  ASSERT_TRUE(database_->run_script("ALTER TABLE elsewhere RENAME TO attendance"));
  explains("mp3", 1);
  run(60.0);
  begins();
  explains("zuse", 2);
  for (int i = 0; i < 2; ++i) desk_->store("open", now_);
  const auto stops = *std::move(*Statistics::open(*database_))->attendance("");
  ASSERT_EQ(stops.size(), 4U);
  const std::vector<int> people{6, 4, 1, 2};
  const std::vector<int> numbers{1, 2, 3, 1};
  for (std::size_t i = 0; i < stops.size(); ++i) {
    EXPECT_EQ(stops[i].stop.people, people[i]);
    EXPECT_EQ(stops[i].stop.stop, numbers[i]);
    EXPECT_EQ(stops[i].stop.tour, "highlights");
    EXPECT_EQ(stops[i].mode, "open");
  }
  EXPECT_EQ(stops[1].stop.exhibit, "airbus");
  EXPECT_EQ(stops[0].stop.tour_began, time_from_seconds(1000.0));
  EXPECT_TRUE(std::move(*Statistics::open(*database_))->attendance("2000-01-01")->empty());
}

TEST_F(CountDeskTest, CountsATouchOnceHoweverLongItLasts) {
  const auto feels = [&](std::uint8_t segment) {
    docent_msgs::Tactile ring;
    ring.header.stamp = to_message(now_);
    ring.segments = {0, segment, 0};
    desk_->see(ring);
    run(0.1);
  };
  for (int i = 0; i < 30; ++i) feels(i % 5 == 4 ? 0 : 1);  // a hand that trembles
  for (int i = 0; i < 20; ++i) feels(255);                 // no reading
  feels(1);
  desk_->store("open", now_);
  EXPECT_EQ(day().counts.at(Counted::contacts), 2.0);
}

TEST_F(CountDeskTest, CountsEachAnswerToThePoll) {
  const auto answers = [&](const std::string& id, PollQuestion question, PollAnswer answer) {
    desk_->answered(id, question, answer);
  };
  answers("1", PollQuestion::liked, PollAnswer::yes);
  answers("1", PollQuestion::liked, PollAnswer::yes);  // said twice
  answers("2", PollQuestion::satisfied, PollAnswer::no);
  answers("3", PollQuestion::price, PollAnswer::undecided);
  answers("4", PollQuestion::intelligence, PollAnswer::human);
  answers("5", PollQuestion::intelligence, PollAnswer::amoeba);
  desk_->store("open", now_);
  const auto counts = day().counts;
  for (const Counted one :
       {Counted::liked_yes, Counted::satisfied_no, Counted::price_undecided, Counted::human, Counted::amoeba})
    EXPECT_EQ(counts.at(one), 1.0) << to_text(one);
  EXPECT_EQ(counts.size(), 5U);
}

TEST_F(CountDeskTest, CountsEachRequestOnceBySourceAndByItsEnd) {
  docent_msgs::RequestBoard board;
  board.requests = {request("old", RequestSource::web, RequestStatus::fulfilled, time_from_seconds(5)),
                    request("a", RequestSource::web, RequestStatus::queued),
                    request("b", RequestSource::kiosk, RequestStatus::active)};
  desk_->see(board);
  run(1.0);
  board.requests[1] = request("a", RequestSource::web, RequestStatus::fulfilled);
  board.requests[2] = request("b", RequestSource::kiosk, RequestStatus::failed);
  board.requests.push_back(request("c", RequestSource::vote, RequestStatus::queued));
  for (int i = 0; i < 3; ++i) desk_->see(board);
  desk_->store("open", now_);
  const auto counts = day().counts;
  EXPECT_EQ(counts.at(Counted::web), 1.0);
  EXPECT_EQ(counts.at(Counted::kiosk), 1.0);
  EXPECT_EQ(counts.at(Counted::vote), 1.0);
  EXPECT_EQ(counts.at(Counted::fulfilled), 1.0);
  EXPECT_EQ(counts.at(Counted::failed), 1.0);
}

TEST_F(CountDeskTest, CountsWhoComesByTheWeb) {
  for (const char* address : {"192.0.2.1", "192.0.2.1", "192.0.2.2"}) desk_->arrived(address);
  desk_->asked(100);
  desk_->voted();
  desk_->store("web", now_);
  desk_->asked(130);
  desk_->store("web", now_);
  EXPECT_EQ(day("web").web_visitors, 2);
  EXPECT_EQ(day("web").counts.at(Counted::accesses), 130.0);
  EXPECT_EQ(day("web").counts.at(Counted::votes), 1.0);
}

TEST_F(CountDeskTest, WhatCouldNotBeStoredIsStoredWithWhatComes) {
  drive(10.0, 0.5);
  desk_->arrived("192.0.2.1");
  desk_->voted();
  ASSERT_TRUE(database_->run_script("ALTER TABLE robot_counter RENAME TO elsewhere"));
  desk_->store("open", now_);
  EXPECT_NE(desk_->fault(), "");
  EXPECT_TRUE(day().counts.empty()) << "all of it, or nothing";
  ASSERT_TRUE(database_->run_script("ALTER TABLE elsewhere RENAME TO robot_counter"));
  desk_->voted();
  desk_->store("open", now_);
  EXPECT_EQ(desk_->fault(), "");
  EXPECT_NEAR(day().counts.at(Counted::distance_m), 5.0, 0.1);
  EXPECT_NEAR(day().counts.at(Counted::max_speed), 0.5, 1e-9);
  EXPECT_EQ(day().counts.at(Counted::votes), 2.0);
  EXPECT_EQ(day().web_visitors, 1);
}

TEST_F(CountDeskTest, TwoGatewaysCountTheRobotOnce) {
  const auto other = make("two");
  desks_.push_back(other.get());
  happens(EventKind::tour_completed);
  desk_->store("open", now_);
  other->store("open", now_);
  EXPECT_EQ(day().counts.at(Counted::tours), 1.0);
  // The first is gone: the other goes on.
  desk_.reset();
  desks_ = {other.get()};
  run(40.0);
  happens(EventKind::tour_completed);
  other->store("open", now_);
  EXPECT_EQ(day().counts.at(Counted::tours), 2.0);
}

}  // namespace
}  // namespace docent::telepresence
