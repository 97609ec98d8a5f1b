#include "docent/vision/ceiling/mosaic_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "docent/vision/ceiling/testing.h"

namespace docent::vision::mosaic_solver_test {
namespace {

using ceiling_testing::camera;
using ceiling_testing::DrawnPicture;
using ceiling_testing::Hall;

/// A drive under a hall, with poses that a localizer gives: 5 cm and 1 degree off.
struct Drive {
  std::vector<Pose2> truth;
  std::vector<DrawnPicture> drawn;
  std::vector<PlacedPicture> placed;
};

Drive drive(const Hall& hall, const CeilingCamera& eye, std::uint64_t seed) {
  Drive drive;
  Rng rng{seed};
  for (int line = 0; line < 6; ++line) {
    for (int i = 0; i < 11; ++i) {
      const double along = 1.8 + 0.65 * i, heading = line % 2 == 0 ? 0.0 : 180.0;
      const Pose2 at{line % 2 == 0 ? along : 10.0 - along, 1.8 + 0.85 * line,
                     Angle::degrees(heading + rng.uniform(-25.0, 25.0))};
      drive.truth.push_back(at);
      drive.drawn.push_back(hall.picture(
          eye, at, {.gain = rng.uniform(0.7, 1.2), .offset = rng.uniform(-0.05, 0.08), .noise = 0.015}, rng));
    }
  }
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    const Pose2 off{drive.truth[i].x + rng.normal(0.0, 0.05), drive.truth[i].y + rng.normal(0.0, 0.05),
                    drive.truth[i].theta + Angle::degrees(rng.normal())};
    drive.placed.push_back({drive.drawn[i].view(), off});
  }
  return drive;
}

/// Root of the mean square distance of the poses from the truth.
double off(const std::vector<PlacedPicture>& placed, const std::vector<Pose2>& truth) {
  double squares = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double away = distance(placed[i].map_from_robot.position(), truth[i].position());
    squares += away * away;
  }
  return std::sqrt(squares / static_cast<double>(truth.size()));
}

MosaicSolverParams small() {
  MosaicSolverParams params;
  params.blocks = {6, 3, 2};
  params.sweep.most = 9.0;
  params.sweep.pictures = 40;
  return params;
}

TEST(MosaicPair, JacobianIsThatOfFiniteDifferences) {
  const Hall hall{.seed = 3};
  const CeilingCamera eye = camera();
  Rng rng{5};
  const auto first = hall.picture(eye, {3.0, 3.0, {}}, {}, rng),
             second = hall.picture(eye, {3.4, 3.2, Angle::degrees(30.0)}, {.gain = 0.8}, rng);
  const ShrunkPicture one{first.view(), 6}, other{second.view(), 6};
  std::vector<PartSample> samples;
  for (int i = 0; i < 12; ++i)
    samples.push_back(
        {{static_cast<float>(-0.3 + 0.05 * i), static_cast<float>(0.2 - 0.04 * i), static_cast<float>(0.3 + 0.02 * i)},
         static_cast<std::uint8_t>(i % 2)});
  const MosaicPair pair{eye, samples, {0, 1}, other, {}};
  std::vector<std::vector<double>> values{
      {3.02, 3.0, 0.01}, {0.05, 0.01}, {3.38, 3.21, 0.5}, {-0.2, 0.02}, {0.012, -0.02}, {3.0}, {3.4}};
  std::vector<std::vector<double>> jacobians;
  for (const auto& value : values) jacobians.emplace_back(12 * value.size());
  const auto evaluate = [&](double** to) {
    std::vector<const double*> pointers;
    for (const auto& value : values) pointers.push_back(value.data());
    std::vector<double> residuals(12);
    EXPECT_TRUE(pair.Evaluate(pointers.data(), residuals.data(), to));
    return residuals;
  };
  std::vector<double*> to;
  for (auto& jacobian : jacobians) to.push_back(jacobian.data());
  const auto residuals = evaluate(to.data());
  for (std::size_t block = 0; block < values.size(); ++block) {
    for (std::size_t k = 0; k < values[block].size(); ++k) {
      const double kept = values[block][k];
      values[block][k] = kept + 1e-6;
      const auto above = evaluate(nullptr);
      values[block][k] = kept - 1e-6;
      const auto below = evaluate(nullptr);
      values[block][k] = kept;
      for (std::size_t n = 0; n < residuals.size(); ++n) {
        const double slope = (above[n] - below[n]) / 2e-6;
        EXPECT_NEAR(jacobians[block][n * values[block].size() + k], slope, 1e-3 * (1.0 + std::abs(slope)))
            << block << " " << k << " " << n;
      }
    }
  }
}

TEST(SolveMosaic, FindsPosesHeightsAndLight) {
  const Hall hall{.seed = 11};
  const CeilingCamera eye = camera();
  const Drive ride = drive(hall, eye, 2);
  const auto solved = solve_mosaic(eye, ride.placed, small());
  ASSERT_TRUE(solved) << solved.error().message;
  EXPECT_EQ(solved->unknowns, 5 * ride.truth.size() + solved->mosaic.heights.size() + 2) << "and the mount";
  EXPECT_GT(off(ride.placed, ride.truth), 0.06);
  EXPECT_LT(off(solved->pictures, ride.truth), 0.03);
  ASSERT_EQ(solved->mosaic.heights.size(), 2U);
  EXPECT_NEAR(solved->mosaic.heights[0], hall.low, 0.02 * hall.low);
  EXPECT_NEAR(solved->mosaic.heights[1], hall.high, 0.02 * hall.high);
  // In the middle of the opening, and far from it.
  const auto part_at = [&](Point2 at) {
    return solved->mosaic.part[solved->mosaic.frame.index(solved->mosaic.frame.cell_at(at))];
  };
  EXPECT_EQ(part_at({5.2, 4.0}), 1);
  EXPECT_EQ(part_at({2.5, 2.0}), 0);
  EXPECT_EQ(part_at({8.0, 5.5}), 0);
}

TEST(SolveMosaic, RefusesWhatTellsNothing) {
  Hall hall{.seed = 12};
  hall.is_plain = true;
  hall.size = {0.0, 0.0};
  const CeilingCamera eye = camera();
  const Drive ride = drive(hall, eye, 4);
  const auto plain = solve_mosaic(eye, ride.placed, small());
  ASSERT_FALSE(plain);
  EXPECT_NE(plain.error().message.find("plain"), std::string::npos);
  EXPECT_FALSE(solve_mosaic(eye, std::span{ride.placed}.first(2), small()));
}

}  // namespace
}  // namespace docent::vision::mosaic_solver_test
