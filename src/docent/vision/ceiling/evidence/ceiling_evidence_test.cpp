#include "docent/vision/ceiling/evidence/ceiling_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "docent/vision/ceiling/testing.h"

namespace docent::vision::ceiling_evidence_test {
namespace {

using ceiling_testing::camera;
using ceiling_testing::Hall;
using ceiling_testing::Light;
using localization::ObservationMoment;

CeilingMosaic mosaic_of_hall(const Hall& hall) {
  CeilingMosaic mosaic{{500, 400, 0.02, {0.0, 0.0}}, {hall.low, hall.high}, {}, {}};
  for (int row = 0; row < mosaic.frame.rows; ++row)
    for (int column = 0; column < mosaic.frame.columns; ++column) {
      const Point2 at = mosaic.frame.centre({column, row});
      mosaic.part.push_back(hall.is_high(at) ? 1 : 0);
      mosaic.brightness.push_back(static_cast<float>(hall.brightness(at)));
    }
  return mosaic;
}

/// All poses of a grid over the hall.
std::vector<Pose2> all_poses() {
  std::vector<Pose2> poses;
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      for (int turn = 0; turn < 60; ++turn)
        poses.push_back({1.05 + 0.2 * column, 1.05 + 0.2 * row, Angle::degrees(6.0 * turn)});
  return poses;
}

struct Seen {
  bool said = false;
  std::vector<double> posterior;
  double most = 0.0;  ///< of a pose and its surroundings
  Pose2 best;
};

/// What a picture says over all poses, from an even belief, `after` what was believed before.
Seen look(CeilingEvidence& evidence, const GrayPicture& picture, const std::vector<Pose2>& poses) {
  Seen seen;
  evidence.see(picture, time_from_seconds(1.0), {});
  seen.said = evidence.observe({time_from_seconds(1.0), {}, {}});
  if (!seen.said) return seen;
  std::vector<float> nats(poses.size());
  evidence.add_costs(poses, nats);
  double sum = 0.0;
  for (const float cost : nats) sum += seen.posterior.emplace_back(std::exp(-static_cast<double>(cost)));
  for (double& mass : seen.posterior) mass /= sum;
  seen.best = poses[static_cast<std::size_t>(std::max_element(seen.posterior.begin(), seen.posterior.end()) -
                                             seen.posterior.begin())];
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (distance(poses[i].position(), seen.best.position()) < 0.5 &&
        std::abs((poses[i].theta - seen.best.theta).degrees()) < 20.0)
      seen.most += seen.posterior[i];
  return seen;
}

Pose2 any_place(Rng& rng) {
  return {rng.uniform(2.5, 7.5), rng.uniform(2.2, 5.8), Angle::degrees(rng.uniform(-180.0, 180.0))};
}

TEST(CeilingEvidence, OnePictureNamesThePlaceWhereTheCeilingIsUnique) {
  const CeilingCamera eye = camera();
  const std::vector<Pose2> poses = all_poses();
  Rng rng{4};
  int right = 0;
  for (std::uint64_t seed = 21; seed < 31; ++seed) {
    const Hall hall{.seed = seed};
    CeilingEvidence evidence{mosaic_of_hall(hall), eye};
    const Pose2 truth = any_place(rng);
    const auto picture = hall.picture(
        eye, truth, {.gain = rng.uniform(0.6, 1.2), .offset = 0.03, .noise = 0.02, .lean = rng.normal(0.0, 0.005)},
        rng);
    const Seen seen = look(evidence, picture.view(), poses);
    ASSERT_TRUE(seen.said);
    if (distance(seen.best.position(), truth.position()) < 0.3 &&
        std::abs((seen.best.theta - truth.theta).degrees()) < 10.0)
      ++right;
  }
  EXPECT_GE(right, 9);
}

TEST(CeilingEvidence, LightChangesNothing) {
  const CeilingCamera eye = camera();
  const Hall hall{.seed = 5};
  CeilingEvidence evidence{mosaic_of_hall(hall), eye};
  const Pose2 truth{5.0, 3.0, Angle::degrees(70.0)};
  Rng rng{1};
  std::vector<double> correlations;
  for (const Light light : {Light{}, Light{.gain = 0.5}, Light{.gain = 0.9, .offset = 0.08}}) {
    const auto picture = hall.picture(eye, truth, light, rng);
    evidence.see(picture.view(), time_from_seconds(1.0), {});
    correlations.push_back(evidence.correlation(truth).value());
  }
  EXPECT_GT(correlations[0], 0.93);
  EXPECT_NEAR(correlations[1], correlations[0], 0.03);  // other samples lie at edges
  EXPECT_NEAR(correlations[2], correlations[0], 0.03);
}

TEST(CeilingEvidence, PlainOrDarkCeilingsSayNothing) {
  const CeilingCamera eye = camera();
  Hall plain{.seed = 5};
  plain.is_plain = true;
  plain.size = {0.0, 0.0};
  CeilingEvidence evidence{mosaic_of_hall(plain), eye};
  Rng rng{1};
  EXPECT_FALSE(look(evidence, plain.picture(eye, {5.0, 4.0, {}}, {.noise = 0.015}, rng).view(), all_poses()).said);
  const Hall hall{.seed = 5};
  CeilingEvidence in_the_dark{mosaic_of_hall(hall), eye};
  EXPECT_FALSE(
      look(in_the_dark, hall.picture(eye, {5.0, 4.0, {}}, {.gain = 0.02, .noise = 0.015}, rng).view(), all_poses())
          .said);
}

TEST(CeilingEvidence, IsNotSureWhereTheCeilingRepeatsItself) {
  const CeilingCamera eye = camera();
  Hall hall{.seed = 8, .period = 2.0};
  hall.size = {0.0, 0.0};
  CeilingEvidence evidence{mosaic_of_hall(hall), eye};
  Rng rng{3};
  const Pose2 truth{5.03, 4.02, Angle::degrees(33.0)};
  const auto picture = hall.picture(eye, truth, {.noise = 0.02}, rng);
  const Seen seen = look(evidence, picture.view(), all_poses());
  ASSERT_TRUE(seen.said);
  EXPECT_LT(seen.most, 0.25);  // of a dozen places that look alike
  EXPECT_NEAR(evidence.correlation(truth).value(), evidence.correlation({3.03, 4.02, truth.theta}).value(), 0.02);
}

TEST(CeilingEvidence, IsNotSureAndWrongWhenTheLampsAreOff) {
  const CeilingCamera eye = camera();
  const std::vector<Pose2> poses = all_poses();
  Rng rng{9};
  for (std::uint64_t seed = 61; seed < 67; ++seed) {
    Hall hall{.seed = seed};
    CeilingEvidence evidence{mosaic_of_hall(hall), eye};
    hall.lamps_are_lit = false;
    const Pose2 truth = any_place(rng);
    const auto picture = hall.picture(eye, truth, {.gain = 0.5, .noise = 0.02}, rng);
    const Seen seen = look(evidence, picture.view(), poses);
    if (!seen.said) continue;
    EXPECT_TRUE(seen.most < 0.9 || distance(seen.best.position(), truth.position()) < 0.5) << seed;
  }
}

TEST(CeilingEvidence, PictureOfAnotherCeilingIsNotBelieved) {
  const CeilingCamera eye = camera();
  const std::vector<Pose2> poses = all_poses();
  Rng rng{6};
  int sure = 0;
  for (std::uint64_t seed = 41; seed < 49; ++seed) {
    CeilingEvidence evidence{mosaic_of_hall({.seed = seed}), eye};
    const auto picture = Hall{.seed = seed + 1000}.picture(eye, any_place(rng), {.noise = 0.02}, rng);
    const Seen seen = look(evidence, picture.view(), poses);
    if (seen.said && seen.most > 0.5) ++sure;
  }
  EXPECT_EQ(sure, 0);
}

TEST(CeilingEvidence, SaysEachPictureOnceAndOnlyWhenTheRobotHasMoved) {
  const CeilingCamera eye = camera();
  const Hall hall{.seed = 5};
  CeilingEvidence evidence{mosaic_of_hall(hall), eye};
  Rng rng{1};
  const auto picture = hall.picture(eye, {5.0, 4.0, {}}, {}, rng);
  const auto says = [&](double seconds, const Pose2& odom) {
    return evidence.observe({time_from_seconds(seconds), odom, {}});
  };
  EXPECT_FALSE(says(1.0, {}));
  evidence.see(picture.view(), time_from_seconds(1.0), {});
  EXPECT_FALSE(says(2.0, {}));  // too old
  EXPECT_TRUE(says(1.1, {}));
  EXPECT_FALSE(says(1.2, {}));
  evidence.see(picture.view(), time_from_seconds(1.5), {0.02, 0.0, {}});
  EXPECT_FALSE(says(1.5, {0.02, 0.0, {}}));
  evidence.see(picture.view(), time_from_seconds(1.7), {0.2, 0.0, {}});
  EXPECT_TRUE(says(1.7, {0.2, 0.0, {}}));
}

TEST(CeilingEvidence, CarriesThePictureOnByOdometry) {
  const CeilingCamera eye = camera();
  const Hall hall{.seed = 5};
  CeilingEvidence evidence{mosaic_of_hall(hall), eye};
  Rng rng{1};
  const Pose2 then{5.0, 4.0, Angle::degrees(20.0)}, moved{0.3, 0.1, Angle::degrees(15.0)};
  const auto picture = hall.picture(eye, then, {}, rng);
  evidence.see(picture.view(), time_from_seconds(1.0), {});
  ASSERT_TRUE(evidence.observe({time_from_seconds(1.2), moved, {}}));
  const std::vector<Pose2> poses{then * moved, then};
  std::vector<float> nats(2);
  evidence.add_costs(poses, nats);
  EXPECT_LT(nats[0], 1.0F);
  EXPECT_GT(nats[1], nats[0] + 1.0F);
}

TEST(CeilingEvidence, WhereNothingIsMappedItCostsTheMean) {
  const CeilingCamera eye = camera();
  const Hall hall{.seed = 5};
  CeilingEvidence evidence{mosaic_of_hall(hall), eye};
  Rng rng{1};
  const auto picture = hall.picture(eye, {5.0, 4.0, {}}, {}, rng);
  evidence.see(picture.view(), time_from_seconds(1.0), {});
  ASSERT_TRUE(evidence.observe({time_from_seconds(1.0), {}, {}}));
  const std::vector<Pose2> poses{{50.0, 4.0, {}}};
  std::vector<float> nats(1);
  evidence.add_costs(poses, nats);
  EXPECT_FLOAT_EQ(nats[0], static_cast<float>(evidence.mean_cost()));
  EXPECT_GT(evidence.mean_cost(), 1.0);
}

TEST(LearnIndependent, FindsMoreThanTheDefaultCounts) {
  // Halls that no other test judges. Places within 0.6 m and 20 degrees: how sharp may a picture be?
  const CeilingCamera eye = camera();
  std::vector<EvidenceTrial> trials;
  Rng rng{12};
  for (std::uint64_t seed = 101; seed < 113; ++seed) {
    const Hall hall{.seed = seed};
    CeilingEvidence evidence{mosaic_of_hall(hall), eye};
    for (int i = 0; i < 3; ++i) {
      const Pose2 truth = any_place(rng);
      const auto picture =
          hall.picture(eye, truth, {.gain = rng.uniform(0.6, 1.2), .noise = 0.02, .lean = rng.normal(0.0, 0.01)}, rng);
      evidence.see(picture.view(), time_from_seconds(1.0), {});
      EvidenceTrial trial;
      for (int x = -6; x <= 6; ++x)
        for (int y = -6; y <= 6; ++y)
          for (int turn = -4; turn <= 4; ++turn) {
            if (x == 0 && y == 0 && turn == 0) trial.truth = trial.correlations.size();
            const Pose2 pose{truth.x + 0.1 * x, truth.y + 0.1 * y, truth.theta + Angle::degrees(5.0 * turn)};
            trial.correlations.push_back(evidence.correlation(pose).value_or(0.0));
          }
      trials.push_back(std::move(trial));
    }
  }
  const double learned = learn_independent(trials);
  EXPECT_GT(learned, 1.3 * CeilingEvidenceParams{}.independent);
  EXPECT_LT(learned, 4.0 * CeilingEvidenceParams{}.independent);
  RecordProperty("independent", std::to_string(learned));
}

TEST(LearnIndependent, FindsTheNumberThatMadeThem) {
  // Trials drawn from the model itself: two places, P(truth) = 1 / (1 + exp(-n d)).
  constexpr double kTrue = 9.0;
  Rng rng{2};
  std::vector<EvidenceTrial> trials;
  for (int i = 0; i < 4000; ++i) {
    const double a = rng.uniform(0.3, 0.9), b = rng.uniform(0.3, 0.9);
    const double odds = 0.5 * kTrue * (std::log1p(-b * b) - std::log1p(-a * a));
    trials.push_back({{a, b}, rng.chance(1.0 / (1.0 + std::exp(-odds))) ? 0U : 1U});
  }
  EXPECT_NEAR(learn_independent(trials), kTrue, 0.8);
}

}  // namespace
}  // namespace docent::vision::ceiling_evidence_test
