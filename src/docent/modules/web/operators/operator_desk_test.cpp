#include "docent/modules/web/operators/operator_desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/messages/topics.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

using telepresence::Caller;
using telepresence::LeaseMessage;
using telepresence::Role;
using telepresence::SteerMessage;
using telepresence::StopMessage;

class OperatorDeskTest : public testing::Test {
 protected:
  OperatorDeskTest() : file_{testing::TempDir() + "/stopped-" + std::to_string(::getpid())} {
    std::filesystem::remove(file_);
    world_->subscribe<docent_msgs::Steering>(topics::kSteering, [this](const auto& m) { steered_.push_back(m); });
    world_->subscribe<docent_msgs::Stop>(topics::kStop, [this](const auto& m) { stops_.push_back(m); });
    world_->subscribe<docent_msgs::Limits>(topics::kLimits, [this](const auto& m) { limits_ = m; });
    begin();
  }
  ~OperatorDeskTest() override { std::filesystem::remove(file_); }
  void begin() {
    bus_ = hub_.connect("web" + std::to_string(++starts_));
    desk_ = std::make_unique<OperatorDesk>(
        *bus_, file_, [this](const std::string& who, const std::string& what, const std::string& about) {
          notes_.push_back(who + " " + what + " " + about);
        });
  }
  Reason take(const Caller& caller, const telepresence::ClientMessage& message) {
    auto done = desk_->take(caller, message);
    EXPECT_TRUE(done);
    return *done;
  }
  void run(double duration) { hub_.run_until(hub_.now() + seconds(duration)); }
  void steer(const Caller& caller, double duration) {
    for (int i = 0; i < static_cast<int>(duration * 10.0); ++i) {
      EXPECT_EQ(take(caller, SteerMessage{true, 0.5, -0.25}), Reason{});
      run(0.1);
    }
  }

  const std::string file_;
  const Caller ada_{1, Role::staff, "ada"}, grace_{2, Role::staff, "grace"};
  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  int starts_ = 0;
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<OperatorDesk> desk_;
  std::vector<docent_msgs::Steering> steered_;
  std::vector<docent_msgs::Stop> stops_;
  std::optional<docent_msgs::Limits> limits_;
  std::vector<std::string> notes_;
};

TEST_F(OperatorDeskTest, NobodySteersWithoutTheLease) {
  EXPECT_EQ(take(ada_, SteerMessage{true, 1.0, 0.0}), Reason{ReasonWord::no_lease});
  run(1.0);
  EXPECT_TRUE(steered_.empty());
  EXPECT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  EXPECT_EQ(take(grace_, LeaseMessage{"id", true}), (Reason{ReasonWord::no_lease, "ada"}));
  EXPECT_EQ(take(grace_, SteerMessage{true, 1.0, 0.0}), (Reason{ReasonWord::no_lease, "ada"}));
  run(0.5);
  ASSERT_FALSE(steered_.empty());
  for (const auto& message : steered_) EXPECT_FALSE(message.is_pressed) << "the lease alone moves nothing";
}

TEST_F(OperatorDeskTest, TheHolderSteersAsLongAsTheyAreHeard) {
  ASSERT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  steer(ada_, 1.0);
  ASSERT_GE(steered_.size(), 9U);
  EXPECT_TRUE(steered_.back().is_pressed);
  EXPECT_EQ(steered_.back().forward, 0.5);
  EXPECT_EQ(steered_.back().by, "ada");
  EXPECT_EQ(desk_->document().holder, "ada");
  run(0.45);
  EXPECT_FALSE(steered_.back().is_pressed) << "silent, it holds nothing";
  EXPECT_EQ(steered_.back().forward, 0.0);
  EXPECT_EQ(desk_->document().holder, "ada");
  run(2.0);
  EXPECT_EQ(desk_->document().holder, "") << "and at last the lease is gone";
  const std::size_t before = steered_.size();
  run(1.0);
  EXPECT_EQ(steered_.size(), before);
  EXPECT_EQ(take(grace_, LeaseMessage{"id", true}), Reason{});
}

TEST_F(OperatorDeskTest, TheLeaseEndsWithItsConnectionOrWhenItIsGivenBack) {
  ASSERT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  desk_->left(grace_);
  EXPECT_EQ(desk_->document().holder, "ada");
  steer(ada_, 0.3);
  desk_->left(ada_);
  run(0.05);
  EXPECT_EQ(desk_->document().holder, "");
  EXPECT_FALSE(steered_.back().is_pressed) << "at once";
  ASSERT_EQ(take(grace_, LeaseMessage{"id", true}), Reason{});
  ASSERT_EQ(take(grace_, LeaseMessage{"id", false}), Reason{});
  EXPECT_EQ(desk_->document().holder, "");
  EXPECT_EQ(notes_, (std::vector<std::string>{"ada lease taken", "ada lease given back", "grace lease taken",
                                              "grace lease given back"}));
}

TEST_F(OperatorDeskTest, TheStopButtonNeedsNoLeaseAndOutlivesARestart) {
  ASSERT_EQ(take(ada_, LeaseMessage{"id", true}), Reason{});
  EXPECT_EQ(take(grace_, StopMessage{"id", true}), Reason{});
  run(0.1);
  ASSERT_EQ(stops_.size(), 1U);
  EXPECT_TRUE(stops_[0].is_stopped);
  EXPECT_EQ(stops_[0].by, "grace");
  EXPECT_TRUE(desk_->document().is_stopped);
  desk_.reset();
  begin();
  run(0.1);
  ASSERT_EQ(stops_.size(), 2U);
  EXPECT_TRUE(stops_[1].is_stopped);
  EXPECT_EQ(desk_->document().stopped_by, "grace");
  EXPECT_EQ(take(ada_, StopMessage{"id", false}), Reason{});
  run(0.1);
  EXPECT_FALSE(stops_.back().is_stopped);
  desk_.reset();
  begin();
  run(0.1);
  EXPECT_FALSE(desk_->document().is_stopped);
}

TEST_F(OperatorDeskTest, HoursAreSaidAndTheOtherLimitsStay) {
  auto up = hub_.connect("up");
  docent_msgs::Limits limits;
  limits.max_speed = 0.4;
  up->publisher(topics::kLimits).publish(limits);
  run(0.1);
  EXPECT_EQ(take(ada_, telepresence::SetHoursMessage{"id", OperatingMode::web}), Reason{});
  run(0.1);
  ASSERT_TRUE(limits_);
  EXPECT_EQ(limits_->mode, "web");
  EXPECT_EQ(limits_->max_speed, 0.4);
  EXPECT_EQ(desk_->document().hours, "web");
}

TEST_F(OperatorDeskTest, LeavesWhatIsNoOperatorsToOthers) {
  EXPECT_FALSE(desk_->take(ada_, telepresence::RequestMessage{}));
}

}  // namespace
}  // namespace docent::modules
