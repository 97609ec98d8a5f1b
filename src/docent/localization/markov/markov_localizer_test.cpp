#include "docent/localization/markov/markov_localizer.h"

#include <gtest/gtest.h>

#include "docent/localization/markov/testing.h"

namespace docent::localization {
namespace {

LocalizerParams coarse() {
  LocalizerParams params;
  params.states.heading_step = 3.0;
  return params;
}

/// A robot that is driven round the room by hand, with odometry that knows nothing of being carried.
struct Drive {
  OccupancyGrid map = testing::room_map();
  sensor_models::RayCaster caster{map};
  MarkovLocalizer localizer{map, coarse(), {}, 1};
  Pose2 truth{1.0, 0.8, Angle::degrees(20.0)};
  Pose2 odom{};
  double seconds = 0.0;
  Rng rng{3};
  double reach = 10.0;  ///< [m] of the scanner

  [[nodiscard]] sensor_models::RangeSweep look(double hidden) {
    sensor_models::RangeSweep sweep = testing::sweep_at(caster, truth, reach);
    double nearer = 0.0;
    for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
      if (i % 20 == 0) nearer = rng.chance(hidden) ? rng.uniform(0.4, 1.2) : 0.0;
      if (nearer > 0.0) sweep.beams[i].range = std::min(sweep.beams[i].range, nearer);
    }
    return sweep;
  }
  void step(double hidden = 0.0) {
    // Along, and away from what comes near.
    const Pose2 ahead{0.1, 0.0, Angle::degrees(2.0)};
    const bool is_free = caster.clearance((truth * Pose2{0.25, 0.0, {}}).position()) > 0.35F;
    const Pose2 motion = is_free ? ahead : Pose2{0.0, 0.0, Angle::degrees(10.0)};
    truth = truth * motion;
    odom = odom * motion;
    seconds += 0.2;
    localizer.observe(look(hidden), odom, time_from_seconds(seconds));
  }
  [[nodiscard]] double error() const {
    const auto pose = localizer.map_from_robot(odom);
    return pose ? distance(pose->position(), truth.position()) : 1e3;
  }
};

TEST(MarkovLocalizer, FindsItselfAndTracksToCentimetres) {
  Drive drive;
  int steps = 0;
  while (!drive.localizer.verdict().localized() && steps < 150) drive.step(), ++steps;
  ASSERT_TRUE(drive.localizer.verdict().localized());
  double sum = 0.0;
  int sure = 0;
  for (int i = 0; i < 150; ++i) {
    drive.step(0.3);
    const bool is_sure = drive.localizer.verdict().localized();
    EXPECT_TRUE(!is_sure || drive.error() < 0.25) << "step " << i << ": sure, and " << drive.error() << " m off";
    sum += drive.error() / 150.0;
    sure += is_sure ? 1 : 0;
  }
  EXPECT_GE(sure, 140);
  EXPECT_LT(sum, 0.03);
}

/// The share of 150 steps in which a robot is sure and right whose scanner looks `scanner` [m] far and its model
/// `model`.
double sure_and_right(double scanner, double model, bool cuts_at_reach) {
  LocalizerParams params = coarse();
  params.sensor.max_range = model;
  params.cuts_at_reach = cuts_at_reach;
  Drive drive{.localizer = {testing::room_map(), params, {}, 1}};
  drive.reach = scanner;
  for (int i = 0; i < 150; ++i) drive.step();
  int right = 0;
  for (int i = 0; i < 150; ++i) {
    drive.step();
    right += drive.localizer.verdict().localized() && drive.error() < 0.1 ? 1 : 0;
  }
  return right / 150.0;
}

TEST(MarkovLocalizer, AScannerMayLookFartherThanTheModelOrLessFar) {
  EXPECT_GT(sure_and_right(10.0, 10.0, true), 0.95);
  EXPECT_GT(sure_and_right(10.0, 2.5, true), 0.95) << "farther";
  EXPECT_GT(sure_and_right(2.5, 10.0, true), 0.95) << "less far";
  EXPECT_LT(sure_and_right(10.0, 2.5, false), 0.5) << "crippled: far readings contradict near expectations";
}

TEST(MarkovLocalizer, NoticesThatItWasCarriedOffAndFindsItselfAgain) {
  Drive drive;
  for (int i = 0; i < 120; ++i) drive.step();
  ASSERT_TRUE(drive.localizer.verdict().localized());
  ASSERT_LT(drive.error(), 0.1);
  drive.truth = {4.3, 3.2, Angle::degrees(-120.0)};
  int until_noticed = 0;
  while (drive.localizer.verdict().localized() && until_noticed < 100) drive.step(), ++until_noticed;
  EXPECT_LE(until_noticed, 20);  // two metres
  int until_found = 0;
  while ((!drive.localizer.verdict().localized() || drive.error() > 0.3) && until_found < 200)
    drive.step(), ++until_found;
  EXPECT_LE(until_found, 75);  // 15 s
  EXPECT_LT(drive.error(), 0.3);
}

TEST(MarkovLocalizer, WhoIsToldThatItWasCarriedOffDoubtsAtOnceAndFindsItselfAnew) {
  Drive drive;
  for (int i = 0; i < 120; ++i) drive.step();
  ASSERT_TRUE(drive.localizer.verdict().localized());
  drive.truth = {4.3, 3.2, Angle::degrees(-120.0)};
  drive.localizer.uproot();
  EXPECT_FALSE(drive.localizer.verdict().localized()) << "before any sweep";
  EXPECT_LT(drive.localizer.summary().modes.front().mass, 0.8) << "it may be anywhere";
  int until_found = 0;
  while ((!drive.localizer.verdict().localized() || drive.error() > 0.3) && until_found < 200)
    drive.step(), ++until_found;
  EXPECT_LE(until_found, 75);
  EXPECT_LT(drive.error(), 0.3);
}

TEST(MarkovLocalizer, WhoIsToldSoWronglyIsSoonSureAgain) {
  Drive drive;
  for (int i = 0; i < 120; ++i) drive.step();
  drive.localizer.uproot();
  int until_found = 0;
  while (!drive.localizer.verdict().localized() && until_found < 100) drive.step(), ++until_found;
  EXPECT_LE(until_found, 25);  // 5 s
  EXPECT_LT(drive.error(), 0.1);
}

TEST(MarkovLocalizer, CrippledItReckonsDeadOnceItIsSure) {
  Drive drive;
  LocalizerParams params = coarse();
  params.reckons_dead = true;
  MarkovLocalizer dead{drive.map, params, {}, 1};
  const auto look = [&] { return dead.observe(drive.look(0.0), drive.odom, time_from_seconds(drive.seconds)); };
  int updates = 0;
  for (int steps = 0; !dead.verdict().localized() && steps < 150; ++steps) drive.step(), updates += look().updated;
  ASSERT_TRUE(dead.verdict().localized());
  EXPECT_GT(updates, 0);
  const Pose2 last = dead.odom_from_robot();
  drive.truth = {4.3, 3.2, Angle::degrees(-120.0)};
  for (int i = 0; i < 50; ++i) {
    drive.step();
    EXPECT_FALSE(look().updated);
  }
  EXPECT_TRUE(dead.verdict().localized()) << "nothing makes it doubt";
  EXPECT_EQ(dead.odom_from_robot().x, last.x);
}

TEST(MarkovLocalizer, EveryFilterTracksThroughPeople) {
  for (const char* filter : {"none", "entropy", "distance", "novelty"}) {
    Drive drive;
    LocalizerParams params = coarse();
    params.filter = filter;
    MarkovLocalizer localizer{drive.map, params, {}, 1};
    const BeliefMode here{drive.truth, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01}, 1.0};
    localizer.start_at(std::span{&here, 1}, drive.odom, time_from_seconds(0.0));
    for (int i = 0; i < 150; ++i) {
      drive.step(0.4);
      localizer.observe(drive.look(0.4), drive.odom, time_from_seconds(drive.seconds));
    }
    EXPECT_LT(distance(localizer.map_from_robot(drive.odom)->position(), drive.truth.position()), 0.15) << filter;
  }
}

TEST(MarkovLocalizer, ASurroundedRobotFindsItselfByWhatItSeesBetweenPeople) {
  const OccupancyGrid map = testing::room_map();
  const sensor_models::RayCaster caster{map};
  const auto with_share = [&](double person_share) {
    return testing::look_round(caster, 6, [&](std::uint64_t seed) {
      LocalizerParams params = coarse();
      params.person_share = person_share;
      return std::make_unique<MarkovLocalizer>(map, params, RangeTableCache{}, seed);
    });
  };
  const testing::LookingRound by_shapes = with_share(0.1);
  const testing::LookingRound by_all = with_share(1.0);
  EXPECT_GE(by_shapes.likeliest, 5);
  EXPECT_GE(by_shapes.sure, 3);  // others have a rival, until they move
  EXPECT_EQ(by_shapes.wrong, 0);
  EXPECT_LE(by_all.likeliest, 2) << "then people need not be told by their shapes";
}

TEST(MarkovLocalizer, ARobotThatTurnsRoundAndRoundSeesNothingNewButInTime) {
  Drive drive;
  const auto updates = [&](const Pose2& motion, int steps) {
    int count = 0;
    for (int i = 0; i < steps; ++i) {
      drive.truth = drive.truth * motion;
      drive.odom = drive.odom * motion;
      drive.seconds += 0.2;
      count += drive.localizer.observe(drive.look(0.3), drive.odom, time_from_seconds(drive.seconds)).updated ? 1 : 0;
    }
    return count;
  };
  const Pose2 turn{0.0, 0.0, Angle::degrees(10.5)};
  EXPECT_GE(updates(turn, 35), 34) << "a circle";
  EXPECT_LE(updates(turn, 70), 8) << "two more, 14 s";
  updates({0.05, 0.0, {}}, 6);
  EXPECT_GE(updates(turn, 30), 28) << "another place";
}

TEST(MarkovLocalizer, ASectorCountsMoreWhereShapesLeaveEnoughBeams) {
  const LocalizerParams params;
  const auto with_people = [](std::size_t people) {
    std::vector<std::uint8_t> marks(100, 0);
    std::fill_n(marks.begin(), people, std::uint8_t{1});
    return marks;
  };
  EXPECT_EQ(params.sector_nats({}), params.most_sector_nats) << "it has a place to keep";
  EXPECT_EQ(params.sector_nats(with_people(40)), params.most_sector_nats_lost);
  EXPECT_EQ(params.sector_nats(with_people(85)), params.most_sector_nats);
  LocalizerParams recorded;  // walls are not where the map says
  recorded.exact_walls = false;
  EXPECT_EQ(recorded.sector_nats(with_people(40)), recorded.most_sector_nats);
}

/// Readings about the expected range as a bell over bins, or, with no width, as good as any other.
class Bell final : public sensor_models::ReadingDistribution {
 public:
  explicit Bell(double width) : width_{width} {}
  void fill(const sensor_models::RangeBins& /*bins*/, int expected, std::span<double> out) const override {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double off = (static_cast<double>(i) - expected) / width_;
      out[i] = 0.002 + (width_ > 0.0 ? std::exp(-0.5 * off * off) : 0.0);
    }
  }

 private:
  double width_;
};

TEST(MarkovLocalizer, ASensorModelOfOnesOwnIsWhatCounts) {
  const auto error_with = [](double width) {
    Drive drive;
    LocalizerParams params = coarse();
    params.own_sensor = std::make_shared<Bell>(width);
    MarkovLocalizer localizer{drive.map, params, {}, 1};
    for (int i = 0; i < 60; ++i) {
      drive.step();
      localizer.observe(drive.look(0.0), drive.odom, time_from_seconds(drive.seconds));
    }
    const auto found = localizer.map_from_robot(drive.odom);
    return found ? distance(found->position(), drive.truth.position()) : 1e3;
  };
  EXPECT_LT(error_with(3.0), 0.15);
  EXPECT_GT(error_with(0.0), 0.3) << "a sensor that says nothing finds nothing";
}

TEST(MarkovLocalizer, AnUnknownFilterIsAFault) {
  LocalizerParams params;
  params.filter = "magic";
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::localization
