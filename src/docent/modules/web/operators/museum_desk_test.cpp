#include "docent/modules/web/operators/museum_desk.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "docent/base/shipped_files.h"
#include "docent/messages/topics.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

TEST(MuseumDesk, TellsAllModulesToBeginAnewOnceTheAnswerIsOut) {
  transport::VirtualTimeHub hub;
  const auto world = hub.connect("world");
  const auto bus = hub.connect("web");
  std::vector<bool> moved;
  world->subscribe<docent_msgs::MuseumMoved>(topics::kMuseumMoved,
                                             [&](const auto& message) { moved.push_back(message.is_trial); });
  museum::Museum museum;
  museum.folder = shipped_path("museums/bonn");
  const robot::RobotConfig config;
  MuseumDesk desk{{*bus, museum, config, testing::TempDir()}};
  const auto office = desk.office();
  EXPECT_FALSE(office->workshop.is_trial());
  EXPECT_FALSE(office->is_stopped());
  desk.see({"", false, true, "ada", 1, ""});
  EXPECT_TRUE(office->is_stopped());
  // As the desk of /api/v1 does, from its thread.
  std::thread{[&] { office->move(true); }}.join();
  hub.run_until(hub.now() + seconds(0.2));
  EXPECT_TRUE(moved.empty());
  hub.run_until(hub.now() + seconds(0.5));
  EXPECT_EQ(moved, std::vector{true});
  hub.run_until(hub.now() + seconds(5.0));
  EXPECT_EQ(moved.size(), 1U) << "once";
}

}  // namespace
}  // namespace docent::modules
