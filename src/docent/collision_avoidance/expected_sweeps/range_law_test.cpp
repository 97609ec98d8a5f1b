#include "docent/collision_avoidance/expected_sweeps/range_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "docent/base/random.h"

namespace docent::collision_avoidance::range_law_test {
namespace {

/// Readings that depend on 90 expected ones, from 0.8 to 4.4 m.
RangeLaw law_of(double scale, double offset, int others = 0, float of_others = 0.5F) {
  SensorSweep sweep{time_from_seconds(1.0), {}, -0.8, 0.02, 0.05, 10.0, {}};
  std::vector<float> expected;
  for (int i = 0; i < 90; ++i) {
    expected.push_back(static_cast<float>(0.8 + 0.04 * i));
    const double range = i < others ? of_others : scale * static_cast<double>(expected.back()) + offset;
    sweep.ranges.push_back(static_cast<float>(range));
  }
  return find_law(expected, view_of(sweep, {}));
}

TEST(RangeLaw, WhatIsAsExpectedIsNoLie) {
  const RangeLaw law = law_of(1.0, 0.03);
  EXPECT_EQ(law.compared, 90);
  EXPECT_TRUE(law.is_as_expected(0.95));
  EXPECT_FALSE(is_lie(law));
}

TEST(RangeLaw, FindsAnOffsetAndAFactorAmongPeople) {
  for (const double offset : {-0.4, 0.2, 0.5, 1.0}) {
    const RangeLaw law = law_of(1.0, offset, 20);
    EXPECT_TRUE(is_lie(law)) << offset;
    EXPECT_NEAR(law.offset, offset, 0.05);
    EXPECT_EQ(law.scale, 1.0);
  }
  for (const double scale : {0.3048, 0.5, 2.0, 2.2}) {
    const RangeLaw law = law_of(scale, 0.0, 20);
    EXPECT_TRUE(is_lie(law)) << scale;
    EXPECT_NEAR(law.scale, scale, 0.05);
    EXPECT_EQ(law.offset, 0.0);
  }
}

TEST(RangeLaw, WhatFollowsNoLawIsNoLie) {
  EXPECT_FALSE(is_lie(law_of(2.0, 0.0, 40)));  // too many people
  SensorSweep sweep{time_from_seconds(1.0), {}, -0.8, 0.02, 0.05, 10.0, {}};
  std::vector<float> expected;
  Rng rng{3};
  for (int i = 0; i < 90; ++i) {  // another place
    expected.push_back(static_cast<float>(rng.uniform(0.5, 6.0)));
    sweep.ranges.push_back(static_cast<float>(rng.uniform(0.5, 6.0)));
  }
  EXPECT_FALSE(is_lie(find_law(expected, view_of(sweep, {}))));
  expected.resize(10);
  sweep.ranges.assign(10, 4.0F);
  EXPECT_FALSE(is_lie(find_law(expected, view_of(sweep, {}))));  // too few
}

TEST(RangeLaw, CountsWhatAnswersApart) {
  const RangeLaw off = law_of(1.0, 0.5, 20);
  EXPECT_EQ(off.answered, 90);
  EXPECT_LE(off.answered_as_expected, 3);
  EXPECT_GE(law_of(1.0, 0.02).answered_as_expected, 88);
}

TEST(RangeLaw, SaysItInWords) {
  EXPECT_EQ(to_words(law_of(1.0, 0.5)), "0.5 m too long");
  EXPECT_EQ(to_words(law_of(1.0, -0.4)), "0.4 m too short");
  EXPECT_EQ(to_words(law_of(2.0, 0.0)), "2.0 times too long");
  EXPECT_EQ(to_words(law_of(0.5, 0.0)), "2.0 times too short");
}

}  // namespace
}  // namespace docent::collision_avoidance::range_law_test
