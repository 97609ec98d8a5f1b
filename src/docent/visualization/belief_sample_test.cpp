#include "docent/visualization/belief_sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace docent::visualization {
namespace {

/// Three quarters of the mass in one cell, an eighth in another, an eighth in a square of the rest.
docent_msgs::Belief belief() {
  docent_msgs::Belief belief;
  belief.cell_size = 0.2F;
  belief.heading_step = 0.1F;
  belief.cells = {{1.0F, 2.0F, 0.5F, 0.75F}, {5.0F, 2.0F, -1.0F, 0.125F}};
  belief.rest = {10.0F, 20.0F, 1.0F, 3, 2, {0, 0, 0, 0, 0, 0.125F}};  // column 2 of row 1
  return belief;
}

std::ptrdiff_t near(const std::vector<Pose2>& sample, Point2 place, double within) {
  return std::count_if(sample.begin(), sample.end(), [&](const Pose2& pose) {
    return std::abs(pose.x - place.x) <= within && std::abs(pose.y - place.y) <= within;
  });
}

TEST(BeliefSample, LiesAsTheBeliefDoes) {
  const auto sample = belief_sample(belief(), 800);
  ASSERT_EQ(sample.size(), 800U);
  EXPECT_EQ(near(sample, {1.0, 2.0}, 0.1001), 600);
  EXPECT_EQ(near(sample, {5.0, 2.0}, 0.1001), 100);
  EXPECT_EQ(near(sample, {12.5, 21.5}, 0.5001), 100);
}

TEST(BeliefSample, FillsEachCellEvenlyAndTurnsEveryWayInTheRest) {
  const auto sample = belief_sample(belief(), 800);
  double x = 0.0, heading = 0.0, least = 9.0, most = -9.0;
  std::ptrdiff_t in_corner = 0;
  for (std::size_t i = 0; i < 600; ++i) {
    x += sample[i].x / 600.0;
    heading += sample[i].theta.radians() / 600.0;
    in_corner += sample[i].x < 1.0 && sample[i].y < 2.0 ? 1 : 0;
    EXPECT_NEAR(sample[i].theta.radians(), 0.5, 0.0501);
  }
  EXPECT_NEAR(x, 1.0, 0.005);
  EXPECT_NEAR(heading, 0.5, 0.003);
  EXPECT_NEAR(static_cast<double>(in_corner), 150.0, 10.0);
  for (std::size_t i = 700; i < 800; ++i) {
    least = std::min(least, sample[i].theta.radians());
    most = std::max(most, sample[i].theta.radians());
  }
  EXPECT_LT(least, -0.9 * std::numbers::pi);
  EXPECT_GT(most, 0.9 * std::numbers::pi);
}

TEST(BeliefSample, IsTheSameForTheSameBeliefAndAnotherForAnother) {
  const auto first = belief_sample(belief(), 50);
  const auto second = belief_sample(belief(), 50);
  auto moved = belief();
  moved.cells[0].x += 0.01F;
  const auto third = belief_sample(moved, 50);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].x, second[i].x);
    EXPECT_EQ(first[i].theta.radians(), second[i].theta.radians());
  }
  EXPECT_NE(first[0].x, third[0].x);
}

TEST(BeliefSample, OfNoMassIsEmpty) {
  EXPECT_TRUE(belief_sample({}, 100).empty());
  auto nowhere = belief();
  for (auto& cell : nowhere.cells) cell.mass = -1.0F;
  nowhere.rest.mass.assign(6, 0.0F);
  EXPECT_TRUE(belief_sample(nowhere, 100).empty());
  EXPECT_TRUE(belief_sample(belief(), 0).empty());
  auto odd = belief();
  odd.rest.columns = 0;
  EXPECT_EQ(belief_sample(odd, 8).size(), 8U);
}

}  // namespace
}  // namespace docent::visualization
