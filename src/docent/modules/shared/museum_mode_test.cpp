#include "docent/modules/shared/museum_mode.h"

#include <gtest/gtest.h>

#include "docent/transport/virtual_time_bus.h"

namespace docent::modules {
namespace {

class MuseumModeTest : public testing::Test {
 protected:
  MuseumModeTest() {
    museum.modes = {{"open", {0.7, 0.0, {}}}, {"web", {0.4, 30.0, {"18:30-21:30"}}}, {"closed", {1.63, 0.0, {}}}};
  }
  [[nodiscard]] MuseumMode mode_from(const std::string& begins) const {
    const std::unique_ptr<transport::Bus> bus = hub.connect("test");
    ModuleContext context{*bus, museum, config, {}, 1, true};
    context.day_begins = std::chrono::minutes{std::stoi(begins) * 60};
    return MuseumMode{context};
  }
  static Time at(double minutes) { return time_from_seconds(60.0 * minutes); }

  mutable transport::VirtualTimeHub hub;
  museum::Museum museum;
  robot::RobotConfig config;
};

TEST_F(MuseumModeTest, TheHoursDecideAsLongAsTheOperatorSaysNothing) {
  const MuseumMode mode = mode_from("18");
  EXPECT_EQ(mode.name(at(29)), "open");
  EXPECT_EQ(mode.max_speed(at(29)), 0.7);
  EXPECT_EQ(mode.wait_s(at(29)), 0.0);
  EXPECT_EQ(mode.name(at(30)), "web");
  EXPECT_EQ(mode.max_speed(at(30)), 0.4);
  EXPECT_EQ(mode.wait_s(at(30)), 30.0);
  EXPECT_EQ(mode.name(at(210)), "open");
  EXPECT_EQ(mode.name(at(24 * 60 + 30)), "web") << "the next day";
}

TEST_F(MuseumModeTest, TheOperatorDecidesUntilTheySayHours) {
  MuseumMode mode = mode_from("19");
  mode.limits({1.0, 1.0, "open", true});
  EXPECT_EQ(mode.name({}), "open");
  EXPECT_EQ(mode.max_speed({}), 1.0);
  mode.limits({0.3, 1.0, "hours", false});
  EXPECT_EQ(mode.name({}), "web");
  EXPECT_EQ(mode.max_speed({}), 0.3) << "the slower of both";
  EXPECT_FALSE(mode.takes_requests());
}

TEST_F(MuseumModeTest, SaysWhatComesNextWhileTheHoursDecide) {
  MuseumMode mode = mode_from("18");
  EXPECT_EQ(mode.next(at(0)), (museum::NextMode{"web", 18 * 60 + 30}));
  EXPECT_EQ(mode.next(at(30)), (museum::NextMode{"open", 21 * 60 + 30}));
  mode.limits({0.7, 1.0, "open", true});
  EXPECT_EQ(mode.next(at(0)), std::nullopt) << "until somebody says hours, nothing comes by itself";
}

TEST_F(MuseumModeTest, OpeningHoursCloseTheRestOfTheDay) {
  museum.modes["open"].hours = {"09:00-17:00"};
  EXPECT_EQ(mode_from("10").name({}), "open");
  EXPECT_EQ(mode_from("17").name({}), "closed");
  EXPECT_EQ(mode_from("19").name({}), "web");
  EXPECT_EQ(mode_from("3").name({}), "closed");
}

TEST_F(MuseumModeTest, QuietHoursTakeFromTheVolumeThatTheOperatorAllows) {
  museum.sound.quiet_hours = {"12:00-13:00"};
  museum.sound.quiet_volume = 0.25;
  MuseumMode mode = mode_from("11");
  EXPECT_DOUBLE_EQ(mode.volume(at(59)), 1.0);
  EXPECT_DOUBLE_EQ(mode.volume(at(60)), 0.25);
  mode.limits({0.7, 0.4, "open", true});
  EXPECT_DOUBLE_EQ(mode.volume(at(60)), 0.1) << "whatever the mode";
  EXPECT_DOUBLE_EQ(mode.volume(at(120)), 0.4);
  mode.limits({0.7, 7.0, "open", true});
  EXPECT_DOUBLE_EQ(mode.volume(at(120)), 1.0);
}

TEST_F(MuseumModeTest, AMuseumWithoutModesIsOpen) {
  museum.modes.clear();
  EXPECT_EQ(mode_from("3").name({}), "open");
  EXPECT_EQ(mode_from("3").max_speed({}), std::nullopt);
}

TEST_F(MuseumModeTest, WhoDoesNotKnowItsScannersIsSlowWhateverIsAllowed) {
  MuseumMode mode = mode_from("10");
  docent_msgs::Calibration calibration;
  calibration.most_speed = 0.3;
  mode.calibration(calibration);
  EXPECT_EQ(mode.max_speed(at(1)), 0.3);
  calibration.most_speed = 0.0;
  mode.calibration(calibration);
  EXPECT_EQ(mode.max_speed(at(1)), 0.7);
}

}  // namespace
}  // namespace docent::modules
