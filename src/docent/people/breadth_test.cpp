#include "docent/people/breadth.h"

#include <gtest/gtest.h>

namespace docent::people {
namespace {

constexpr double kLegs = 0.10;  // [m]
constexpr double kBody = 0.35;  // [m]

void see(Breadth& breadth, int people, double width, int sightings = 100) {
  for (int i = 0; i < people; ++i)
    for (int n = 1; n <= sightings; ++n) breadth.learn(n, width);
}

TEST(Breadth, LearnsWhatPeopleLookLike) {
  Breadth legs{{}};
  EXPECT_DOUBLE_EQ(legs.share(), BreadthParams{}.at_first);
  see(legs, 20, kLegs);
  EXPECT_LT(legs.share(), 0.1);
  Breadth bodies{{}};
  see(bodies, 20, kBody);
  EXPECT_GT(bodies.share(), 0.9);
}

TEST(Breadth, OneWhoStaysForLongTellsNoMoreThanOthers) {
  Breadth breadth{{}};
  see(breadth, 30, kLegs);
  const double before = breadth.share();
  see(breadth, 1, kBody, 10000);
  EXPECT_LT(breadth.share(), before + 0.05);
}

TEST(Breadth, WhoWasSeenForAMomentTellsNothing) {
  Breadth breadth{{}};
  see(breadth, 50, kLegs, BreadthParams{}.from);
  EXPECT_DOUBLE_EQ(breadth.share(), BreadthParams{}.at_first);
}

TEST(Breadth, ForgetsOtherHalls) {
  Breadth breadth{{}};
  see(breadth, 1000, kBody);
  see(breadth, 400, kLegs);
  EXPECT_LT(breadth.share(), 0.05);
}

TEST(Breadth, RefusesParametersThatCannotBe) {
  BreadthParams params;
  EXPECT_TRUE(params.validate());
  params.kept = 1.0;
  EXPECT_FALSE(params.validate());
  params = {};
  params.at_first = 1.1;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::people
