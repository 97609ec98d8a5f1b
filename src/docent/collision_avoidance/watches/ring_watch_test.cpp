#include "docent/collision_avoidance/watches/ring_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "docent/base/random.h"

namespace docent::collision_avoidance::ring_watch_test {
namespace {

constexpr std::size_t kSensors = 24;
constexpr double kPeriod = 0.4;  // [s] of one sensor

/// A ring in a corridor: those that look sideways hear the same wall all along, but for noise and the quantum of 1 cm.
struct Corridor {
  RingWatch watch{"sonar reading", "sonars"};
  Rng rng{3};
  double speed = 0.4;  // [m/s]
  double now = 0.0;    // [s]
  double late = 0.0;   // [s]
  double missing = 0.0;
  bool frozen = false;
  std::vector<std::size_t> silent;
  std::vector<double> last = std::vector<double>(kSensors, 5.0);

  void run(double duration) {
    for (const double end = now + duration; now < end; now += kPeriod / kSensors, ++count_) {
      const std::size_t index = count_ * 7 % kSensors;
      if (std::find(silent.begin(), silent.end(), index) != silent.end()) continue;
      if (!frozen) last[index] = measure(index);
      const double range = rng.chance(missing) ? std::numeric_limits<double>::quiet_NaN() : last[index];
      const Pose2 place{speed * (now - late), 0.0, {}};
      watch.hear(time_from_seconds(now), time_from_seconds(now - late), index, range, range < 5.0, place);
    }
  }
  double measure(std::size_t index) {
    const bool sideways = index % 12 >= 5 && index % 12 <= 7;
    const bool ahead = index == 0;
    if (!sideways && !ahead) return 5.0;
    const double way = sideways ? 1.0 : 4.0 - std::fmod(speed * now, 3.0);
    return 0.01 * std::round(100.0 * (way + rng.normal(0.0, 0.008)));
  }
  [[nodiscard]] std::string reason() const {
    const auto found = watch.complaint(time_from_seconds(now), true);
    return found ? found->reason : "";
  }
  [[nodiscard]] double max_speed() const { return watch.complaint(time_from_seconds(now), true)->max_speed; }

 private:
  std::size_t count_ = 0;
};

TEST(RingWatch, DoesNotComplainOfAWallThatIsTheSameAllAlong) {
  Corridor corridor;
  for (int i = 0; i < 9000; ++i) {  // an hour
    corridor.run(0.4);
    ASSERT_EQ(corridor.reason(), "") << "after " << corridor.now << " s";
  }
}

TEST(RingWatch, KnowsAFrozenRingFromItsEchoesAsSoonAsTheBaseMoves) {
  Corridor corridor;
  corridor.run(5.0);
  corridor.frozen = true;
  corridor.run(1.5);
  EXPECT_EQ(corridor.reason(), "the sonars are frozen");
  EXPECT_EQ(corridor.max_speed(), 0.0);
  corridor.frozen = false;
  corridor.run(1.0);
  EXPECT_EQ(corridor.reason(), "");
}

TEST(RingWatch, AStandingRobotHearsTheSameWithoutBeingFrozen) {
  Corridor corridor;
  corridor.speed = 0.0;
  corridor.run(5.0);
  corridor.frozen = true;
  corridor.run(20.0);
  EXPECT_EQ(corridor.reason(), "");
}

TEST(RingWatch, SlowsForHalfTheReadingsAndStandsForNearlyNone) {
  Corridor corridor;
  corridor.run(5.0);
  corridor.missing = 0.5;
  corridor.run(1.0);
  EXPECT_EQ(corridor.reason(), "the sonars give too few readings");
  EXPECT_EQ(corridor.max_speed(), ComplaintParams{}.crippled_speed);
  corridor.missing = 1.0;
  corridor.run(1.5);
  EXPECT_EQ(corridor.max_speed(), 0.0);
}

TEST(RingWatch, StandsForASilentRingAndForTwoNeighboursButNotForOne) {
  Corridor corridor;
  corridor.run(5.0);
  corridor.silent = {23};
  corridor.run(5.0);
  EXPECT_EQ(corridor.reason(), "");
  corridor.silent = {23, 0};
  corridor.run(2.0);
  EXPECT_EQ(corridor.reason(), "no fresh sonar reading of number 23 and the next");
  corridor.now += 1.0;
  EXPECT_EQ(corridor.reason(), "no fresh sonar reading");
}

TEST(RingWatch, SaysThatReadingsComeLate) {
  Corridor corridor;
  corridor.run(5.0);
  corridor.late = 0.3;
  corridor.run(0.5);
  EXPECT_EQ(corridor.reason(), "the sonar reading comes late");
  EXPECT_EQ(corridor.max_speed(), ComplaintParams{}.crippled_speed);
  corridor.late = 0.7;
  corridor.run(0.5);
  EXPECT_EQ(corridor.max_speed(), 0.0);
}

TEST(RingWatch, ARobotWithoutTheRingIsNotBlamed) {
  const RingWatch watch{"infrared reading", "infrared sensors"};
  EXPECT_FALSE(watch.complaint(time_from_seconds(9.0), false));
  EXPECT_TRUE(watch.complaint(time_from_seconds(9.0), true));
}

}  // namespace
}  // namespace docent::collision_avoidance::ring_watch_test
