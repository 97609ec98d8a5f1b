#include "docent/museum/wall_clock.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

namespace docent::museum {
namespace {

class WallClockTest : public testing::Test {
 protected:
  WallClockTest() {
    setenv("TZ", "Europe/Berlin", 1);
    tzset();
  }
  ~WallClockTest() override {
    unsetenv("TZ");
    tzset();
  }
  [[nodiscard]] WallClock clock() {
    return {false, std::chrono::hours{10}, {[this] { return wall_; }, [this] { return steady_; }}};
  }
  /// Seconds since 1970 of a time in UTC.
  static Duration at(int month, int day, int hour, int minute) {
    using namespace std::chrono;
    const sys_days date = year{2026} / month / day;
    return duration_cast<Duration>(date.time_since_epoch()) + hours{hour} + minutes{minute};
  }
  void pass(Duration duration) {
    wall_ += duration;
    steady_ += duration;
  }

  Duration wall_{};
  Duration steady_ = std::chrono::seconds{77};
};

TEST_F(WallClockTest, VirtualTimeHasADayOfItsOwn) {
  const WallClock clock{true, std::chrono::hours{23}, {}};
  EXPECT_EQ(clock.minute_of_day(time_from_seconds(90.0 * 60.0)), 30);
}

TEST_F(WallClockTest, HoursFollowTheWallForthAndBack) {
  const WallClock clock = this->clock();
  const Time never_back = time_from_seconds(1e9);
  wall_ = at(11, 29, 20, 26);
  EXPECT_EQ(clock.minute_of_day(never_back), 21 * 60 + 26);
  wall_ = at(11, 29, 8, 26);  // it had been twelve hours ahead
  EXPECT_EQ(clock.minute_of_day(never_back), 9 * 60 + 26);
}

TEST_F(WallClockTest, DaylightSavingGoesBothWaysAndIsNoChangeOfTheClock) {
  WallClock clock = this->clock();
  wall_ = at(3, 29, 0, 59);
  clock.look();
  EXPECT_EQ(clock.minute_of_day({}), 1 * 60 + 59);
  pass(std::chrono::minutes{2});
  clock.look();
  EXPECT_EQ(clock.minute_of_day({}), 3 * 60 + 1);
  EXPECT_EQ(clock.change(), "");
  wall_ = at(10, 25, 0, 59);
  EXPECT_EQ(clock.minute_of_day({}), 2 * 60 + 59);
  pass(std::chrono::minutes{2});
  EXPECT_EQ(clock.minute_of_day({}), 2 * 60 + 1);
}

TEST_F(WallClockTest, AChangeIsSaidForTenMinutes) {
  WallClock clock = this->clock();
  wall_ = at(11, 29, 8, 26);
  clock.look();
  pass(std::chrono::seconds{1});
  wall_ += std::chrono::milliseconds{400};  // as a network's time turns it
  clock.look();
  EXPECT_EQ(clock.change(), "");
  pass(std::chrono::seconds{1});
  wall_ -= std::chrono::seconds{3670};
  clock.look();
  EXPECT_EQ(clock.change(), "the clock was set back by 61 min 10 s at 09:26");
  pass(std::chrono::minutes{9});
  clock.look();
  EXPECT_NE(clock.change(), "");
  pass(std::chrono::minutes{2});
  EXPECT_EQ(clock.change(), "");
  wall_ += std::chrono::seconds{30};
  clock.look();
  EXPECT_EQ(clock.change().substr(0, 35), "the clock was set ahead by 30 s at ");
}

}  // namespace
}  // namespace docent::museum
