#include "docent/localization/belief/pose_fix.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::localization::pose_fix_test {
namespace {

PoseFix fix_at(double time, double p_wrong) {
  return {{3.0, 2.0, Angle::degrees(90.0)}, {}, {1.0, 0.0, {}}, time_from_seconds(time), p_wrong};
}

float cost_of(const FixEvidence& evidence, const Pose2& pose) {
  std::vector<float> nats(1);
  evidence.add_costs(std::span{&pose, 1}, nats);
  return nats[0];
}

TEST(PoseFix, CountsWhereItIsCarriedOnByOdometry) {
  FixEvidence evidence;
  evidence.take(fix_at(10.0, 0.001));
  // It has driven on by half a metre, which is along y in the map.
  ASSERT_TRUE(evidence.observe({time_from_seconds(10.5), {1.5, 0.0, {}}, {}}));
  EXPECT_LT(cost_of(evidence, {3.0, 2.5, Angle::degrees(90.0)}), 0.01F);
  EXPECT_GT(cost_of(evidence, {3.0, 2.0, Angle::degrees(90.0)}), 5.0F);
  EXPECT_GT(cost_of(evidence, {3.0, 2.5, Angle::degrees(120.0)}), 5.0F);
  EXPECT_FLOAT_EQ(cost_of(evidence, {30.0, 2.5, {}}), 6.0F);
  EXPECT_FALSE(evidence.observe({time_from_seconds(10.6), {1.5, 0.0, {}}, {}})) << "once";
}

TEST(PoseFix, IsNotHeardWhereItIsOldFarOrUnsure) {
  FixEvidence evidence;
  EXPECT_FALSE(evidence.observe({time_from_seconds(10.0), {}, {}}));
  evidence.take(fix_at(10.0, 0.2));
  EXPECT_FALSE(evidence.observe({time_from_seconds(10.1), {1.0, 0.0, {}}, {}}));
  evidence.take(fix_at(10.0, 0.001));
  EXPECT_FALSE(evidence.observe({time_from_seconds(12.0), {1.0, 0.0, {}}, {}}));
  EXPECT_FALSE(evidence.at(time_from_seconds(10.1), {5.0, 0.0, {}}));
  EXPECT_TRUE(evidence.at(time_from_seconds(10.1), {1.1, 0.0, {}}));
}

}  // namespace
}  // namespace docent::localization::pose_fix_test
