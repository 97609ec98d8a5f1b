#include "docent/modules/web/operators/setup_desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "docent/messages/topics.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

class SetupDeskTest : public testing::Test {
 protected:
  SetupDeskTest() {
    std::filesystem::remove_all(root_);
    museum_.folder = root_ / "hall";
    EXPECT_TRUE(museum::MuseumSetup::begin(museum_.folder, {}));
    world_->subscribe<docent_msgs::MuseumMoved>(topics::kMuseumMoved, [this](const auto&) { ++moves_; });
    world_->subscribe<docent_msgs::ExplorationOrder>(topics::kExplorationOrder,
                                                     [this](const auto& m) { orders_.push_back(m.order); });
  }
  ~SetupDeskTest() override { std::filesystem::remove_all(root_); }
  [[nodiscard]] ModuleContext context(bool is_setup) {
    ModuleContext context{*bus_, museum_, config_, root_ / "state"};
    context.is_setup = is_setup;
    return context;
  }

  const std::filesystem::path root_ =
      std::filesystem::temp_directory_path() / ("docent-setup-desk-" + std::to_string(::getpid()));
  transport::VirtualTimeHub hub_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world"), bus_ = hub_.connect("web");
  museum::Museum museum_;
  robot::RobotConfig config_;
  telepresence::Site site_;
  int moves_ = 0;
  std::vector<std::string> orders_;
};

TEST_F(SetupDeskTest, HasNoOfficeWhereNothingIsSetUp) {
  const SetupDesk desk{context(false), site_};
  EXPECT_EQ(desk.office(), nullptr);
}

TEST_F(SetupDeskTest, OrdersAndHasAllModulesBeginAnewOnceTheAnswerIsOut) {
  const SetupDesk desk{context(true), site_};
  const auto office = desk.office();
  ASSERT_NE(office, nullptr);
  EXPECT_EQ(telepresence::state_of(*office)->step, SetupStep::name);
  // As the desk of /api/v1 does, from its thread.
  std::thread{[&] {
    office->order(ExplorationOrder::by_hand);
    office->move();
  }}.join();
  hub_.run_until(hub_.now() + seconds(0.2));
  EXPECT_EQ(orders_, std::vector<std::string>{"by_hand"});
  EXPECT_EQ(moves_, 0);
  hub_.run_until(hub_.now() + seconds(1.0));
  EXPECT_EQ(moves_, 1);
}

}  // namespace
}  // namespace docent::modules
