#include "docent/interaction/attract/crowd_class.h"

#include <gtest/gtest.h>

namespace docent::interaction {
namespace {

TEST(CrowdClass, ACrowdOfTheArchitectureIsCalledAsThere) {
  const CrowdClassParams params;
  EXPECT_EQ(crowd_class(0.02, params), CrowdClass::quiet);
  EXPECT_EQ(crowd_class(0.08, params), CrowdClass::busy);
  EXPECT_EQ(crowd_class(0.2, params), CrowdClass::packed);
  EXPECT_TRUE(params.validate());
  EXPECT_FALSE((CrowdClassParams{0.2, 0.1}.validate()));
}

TEST(RunningMoments, AreThoseOfTheSampleByHand) {
  RunningMoments moments;
  EXPECT_EQ(moments.standardised(7.0), 0.0);
  for (const double value : {1.0, 2.0, 3.0, 6.0}) moments.add(value);
  EXPECT_DOUBLE_EQ(moments.mean(), 3.0);
  EXPECT_DOUBLE_EQ(moments.deviation(), std::sqrt(14.0 / 3.0));
  EXPECT_DOUBLE_EQ(moments.standardised(3.0), 0.0);
  EXPECT_DOUBLE_EQ(moments.standardised(3.0 + moments.deviation()), 1.0);
}

TEST(RunningMoments, NumbersThatAreAllTheSameHaveNoSpread) {
  RunningMoments moments;
  for (int i = 0; i < 5; ++i) moments.add(0.1);
  EXPECT_EQ(moments.standardised(0.2), 0.0);
}

}  // namespace
}  // namespace docent::interaction
