#include "docent/localization/beam_choice/beam_filter.h"

#include <gtest/gtest.h>

#include "docent/localization/markov/testing.h"

namespace docent::localization::beam_filter_test {
namespace {

struct Crowd {
  std::unique_ptr<testing::Room> room = testing::drawn_room();
  std::vector<LikelyState> states;
  sensor_models::RangeSweep sweep;

  /// The robot at the middle of a cell, with people at half a metre in `share` of the directions.
  explicit Crowd(double share) {
    const auto place = room->space.place_at(room->space.frame().cell_at({1.5, 1.2}));
    states.push_back({place, 0, 1.0F});
    const Point2 at = room->space.centre(static_cast<std::size_t>(place));
    sweep = testing::sweep_at(room->caster, {at.x, at.y, Angle{}}, 10.0);
    const auto people = static_cast<std::size_t>(share * static_cast<double>(sweep.beams.size()));
    for (std::size_t i = 0; i < people; ++i) sweep.beams[i].range = std::min(sweep.beams[i].range, 0.5);
  }

  [[nodiscard]] BeamChoice choose(BeamFilter filter, bool keeps_its_place, std::uint64_t seed) const {
    Rng rng{seed};
    return chosen_beams(states, room->table, room->space.headings(), room->model, sweep,
                        {filter, 0.99, 0.1, 1000, keeps_its_place}, 1, rng);
  }
  [[nodiscard]] double mean_of_random_set(bool keeps_its_place) const {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const BeamChoice choice = choose(BeamFilter::distance, keeps_its_place, seed);
      sum += static_cast<double>(choice.used.size()) - static_cast<double>(60 - choice.filtered);
    }
    return sum / 200.0;
  }
};

TEST(ChosenBeams, WithoutAFilterAllCount) {
  const BeamChoice choice = Crowd{0.5}.choose(BeamFilter::none, true, 1);
  EXPECT_EQ(choice.used.size(), 60U);  // directions
  EXPECT_EQ(choice.filtered, 0U);
}

TEST(ChosenBeams, AtMostSoManyCountAndAllWhereNothingIsLikely) {
  const Crowd crowd{0.5};
  Rng rng{1};
  const auto chosen = [&](std::span<const LikelyState> likely, std::size_t most) {
    return chosen_beams(likely, crowd.room->table, crowd.room->space.headings(), crowd.room->model, crowd.sweep,
                        {BeamFilter::distance, 0.99, 0.1, most, true}, 1, rng);
  };
  EXPECT_EQ(chosen({}, 1000).used.size(), 60U);
  EXPECT_EQ(chosen({}, 15).used.size(), 15U);
  EXPECT_LE(chosen(crowd.states, 15).used.size(), 15U);
}

TEST(ChosenBeams, TheDistanceFilterRejectsPeopleAndAgreementCountsThem) {
  const BeamChoice nobody = Crowd{0.0}.choose(BeamFilter::distance, true, 1);
  const BeamChoice crowd = Crowd{0.5}.choose(BeamFilter::distance, true, 1);
  EXPECT_EQ(nobody.filtered, 0U);
  EXPECT_GT(crowd.filtered, 25U);
  EXPECT_GT(crowd.readings.shorter, 25.0);
  EXPECT_GT(crowd.readings.agrees, 25.0);
}

TEST(ChosenBeams, TheRandomSetIsASmallShareOfThoseThatCountInACrowd) {
  const Crowd crowd{0.8};
  const auto filtered = static_cast<double>(crowd.choose(BeamFilter::distance, true, 1).filtered);
  ASSERT_GT(filtered, 40.0);
  EXPECT_NEAR(crowd.mean_of_random_set(false), 0.1 * filtered, 0.5);  // it may be elsewhere: then they are right
  EXPECT_NEAR(crowd.mean_of_random_set(true), 0.1 * (60.0 - filtered), 0.3);
  EXPECT_GT(Crowd{1.0}.mean_of_random_set(true), 0.3);  // never nothing
  const Crowd few{0.3};
  EXPECT_EQ(few.mean_of_random_set(true), few.mean_of_random_set(false));
}

TEST(ChosenBeams, OnPersonShapesAShareCountsWithAndWithoutABelief) {
  const Crowd crowd{0.5};
  BeamChoiceParams params{BeamFilter::distance, 0.99, 0.1, 1000, false, {}, 0.0};
  params.on_persons.assign(crowd.sweep.beams.size(), 0);
  for (std::size_t i = 0; i < params.on_persons.size() / 2; ++i) params.on_persons[i] = 1;
  Rng rng{1};
  const auto choose = [&](std::span<const LikelyState> likely) {
    return chosen_beams(likely, crowd.room->table, crowd.room->space.headings(), crowd.room->model, crowd.sweep, params,
                        1, rng);
  };
  const BeamChoice blind = choose({});
  EXPECT_EQ(blind.used.size(), 30U);
  EXPECT_EQ(blind.filtered, 30U);
  const BeamChoice knowing = choose(crowd.states);
  EXPECT_EQ(knowing.used.size(), 30U);
  EXPECT_EQ(knowing.readings.shorter, 0.0) << "people are no disagreement";
  EXPECT_GT(knowing.readings.agrees, 25.0);
  params.person_share = 1.0;
  EXPECT_EQ(choose({}).used.size(), 60U);
}

}  // namespace
}  // namespace docent::localization::beam_filter_test
