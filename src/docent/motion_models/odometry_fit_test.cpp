#include "docent/motion_models/odometry_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::motion_models {
namespace {

/// A drive through rooms and corridors: `steps` of a quarter of a metre or a turn, with wheels that err as `truth` says
/// and labels that err too.
std::vector<LabelledOdometry> any_drive(Rng& rng, const LabelledMotionNoise& truth, int steps) {
  const auto noisy = [&rng](double position_variance, double heading_variance) {
    return Pose2{rng.normal(0.0, std::sqrt(position_variance)), rng.normal(0.0, std::sqrt(position_variance)),
                 Angle::radians(rng.normal(0.0, std::sqrt(heading_variance)))};
  };
  std::vector<LabelledOdometry> moments;
  Pose2 odometry;
  Pose2 real{3.0, 4.0, Angle::degrees(30)};
  for (int i = 0; i < steps; ++i) {
    moments.push_back({odometry, real * noisy(truth.label_position, truth.label_heading), true});
    const bool turns_on_spot = i % 20 >= 16;
    const Pose2 step{turns_on_spot ? 0.0 : 0.26, 0.0,
                     Angle::degrees(turns_on_spot ? 25.0 : (i / 20 % 3 == 0 ? 3.0 : 0.0))};
    odometry = odometry * step;
    const MotionNoise noise = motion_noise(truth.motion, step);
    real = real * step * noisy(noise.position_variance, noise.heading_variance);
    if (rng.chance(truth.motion.slip_probability * std::min(1.0, step.x / 0.25 + step.theta.radians() / 0.5)))
      real = real * noisy(0.15 * 0.15, std::pow(7.0 * std::numbers::pi / 180.0, 2));
  }
  return moments;
}

std::vector<MotionWindow> windows_of(const std::vector<LabelledOdometry>& moments) {
  std::vector<MotionWindow> windows;
  for (const PlacedWindow& placed : motion_windows(moments)) windows.push_back(placed.window);
  return windows;
}

LabelledMotionNoise any_noise(Rng& rng) {
  LabelledMotionNoise noise;
  noise.motion = {rng.uniform(0.0005, 0.004), rng.uniform(0.0001, 0.002), rng.uniform(0.0002, 0.003),
                  rng.uniform(0.001, 0.01), rng.uniform(0.001, 0.02)};
  noise.label_position = std::pow(rng.uniform(0.01, 0.06), 2);
  noise.label_heading = std::pow(rng.uniform(0.2, 1.0) * std::numbers::pi / 180.0, 2);
  return noise;
}

TEST(MotionWindow, CovarianceIsThatOfManyDrives) {
  // Along a bend of two metres; heading errors at its beginning move its end.
  LabelledMotionNoise truth;
  truth.motion = {0.001, 0.0005, 0.002, 0.003, 0.0};
  truth.label_position = 0.0004;
  truth.label_heading = 0.0002;
  std::vector<Pose2> odometry{{}};
  for (int i = 0; i < 8; ++i) odometry.push_back(odometry.back() * Pose2{0.25, 0.0, Angle::degrees(10)});
  Symmetric3 foreseen;
  const MotionWindow exact = motion_window(odometry, odometry.back());
  for (const double value : exact.error) EXPECT_NEAR(value, 0.0, 1e-12);
  EXPECT_NEAR(exact.way, 2.0, 1e-9);
  EXPECT_NEAR(exact.turn, 80.0 * std::numbers::pi / 180.0, 1e-9);
  foreseen.add(truth.motion.translation_per_metre, exact.unit[translation_per_metre]);
  foreseen.add(truth.motion.translation_per_radian, exact.unit[translation_per_radian]);
  foreseen.add(truth.motion.rotation_per_metre, exact.unit[rotation_per_metre]);
  foreseen.add(truth.motion.rotation_per_radian, exact.unit[rotation_per_radian]);
  foreseen.add(truth.label_position, exact.unit[label_position]);
  foreseen.add(truth.label_heading, exact.unit[label_heading]);

  Rng rng{5};
  const auto noisy = [&rng](double position, double heading) {
    return Pose2{rng.normal(0.0, std::sqrt(position)), rng.normal(0.0, std::sqrt(position)),
                 Angle::radians(rng.normal(0.0, std::sqrt(heading)))};
  };
  Symmetric3 seen;
  constexpr int kDrives = 20000;
  for (int n = 0; n < kDrives; ++n) {
    Pose2 real;
    for (std::size_t i = 1; i < odometry.size(); ++i) {
      const Pose2 step = inverse(odometry[i - 1]) * odometry[i];
      const MotionNoise noise = motion_noise(truth.motion, step);
      real = real * step * noisy(noise.position_variance, noise.heading_variance);
    }
    const Pose2 start = noisy(truth.label_position, truth.label_heading);
    const Pose2 end = real * noisy(truth.label_position, truth.label_heading);
    const auto e = motion_window(odometry, inverse(start) * end).error;
    seen.add(1.0 / kDrives, {e[0] * e[0], e[0] * e[1], e[0] * e[2], e[1] * e[1], e[1] * e[2], e[2] * e[2]});
  }
  EXPECT_NEAR(seen.xx, foreseen.xx, 0.06 * foreseen.xx);
  EXPECT_NEAR(seen.yy, foreseen.yy, 0.06 * foreseen.yy);
  EXPECT_NEAR(seen.tt, foreseen.tt, 0.06 * foreseen.tt);
  EXPECT_NEAR(seen.xy, foreseen.xy, 0.06 * foreseen.yy);
  EXPECT_NEAR(seen.xt, foreseen.xt, 0.06 * std::abs(foreseen.xt) + 1e-4);
  EXPECT_NEAR(seen.yt, foreseen.yt, 0.06 * std::abs(foreseen.yt));
}

TEST(OdometryFit, FindsTheNoiseThatMadeTheDrive) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const LabelledMotionNoise truth = any_noise(rng);
    const auto windows = windows_of(any_drive(rng, truth, 8000));  // 1.7 km
    OdometryFitParams options;
    options.slip_prior = 10.0;
    const auto fit = fit_odometry_model(windows, {}, options);
    ASSERT_TRUE(fit) << fit.error().message;
    const OdometryModelParams& found = fit->noise.motion;
    // What counts are deviations: within 15 % (way) and 25 % (turns).
    const auto deviations = [](double a, double b) { return std::sqrt(a / b); };
    EXPECT_NEAR(deviations(found.rotation_per_metre, truth.motion.rotation_per_metre), 1.0, 0.15);
    EXPECT_NEAR(deviations(found.rotation_per_radian, truth.motion.rotation_per_radian), 1.0, 0.25);
    // Four metres with a bend of ninety degrees; way and turn go together too often to be told apart well.
    const Pose2 drive{4.0, 0.0, Angle::degrees(90)};
    EXPECT_NEAR(
        deviations(motion_noise(found, drive).position_variance, motion_noise(truth.motion, drive).position_variance),
        1.0, 0.12);
    // Of a drive whose shortest windows err more than the labels these are known less well.
    EXPECT_NEAR(std::sqrt(fit->noise.label_heading), std::sqrt(truth.label_heading),
                0.15 * std::sqrt(truth.label_heading) + 0.1 * std::numbers::pi / 180.0);
    EXPECT_NEAR(deviations(fit->noise.label_position, truth.label_position), 1.0, 0.3);
    EXPECT_NEAR(found.slip_probability, truth.motion.slip_probability, 0.5 * truth.motion.slip_probability + 0.002);
    EXPECT_GE(fit->after, fit->before);
    EXPECT_NEAR(fit->drift_length, 0.0, 0.01);
    EXPECT_NEAR(fit->drift_turn, 0.0, 0.01);
    EXPECT_TRUE(found.validate());
  }
}

TEST(OdometryFit, LikelihoodNeverFalls) {
  for (std::uint64_t seed = 30; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng{seed};
    const auto windows = windows_of(any_drive(rng, any_noise(rng), 400));
    const auto fit = fit_odometry_model(windows, any_noise(rng));
    ASSERT_TRUE(fit) << fit.error().message;
    for (std::size_t i = 1; i < fit->history.size(); ++i) EXPECT_GE(fit->history[i], fit->history[i - 1] - 1e-9);
  }
}

TEST(OdometryFit, SeesWheelsThatAreNotCalibrated) {
  Rng rng{4};
  LabelledMotionNoise truth;
  truth.motion.slip_probability = 0.0;
  auto moments = any_drive(rng, truth, 4000);
  // Odometry reads 2 % too long and sees 1 degree a metre of turn that is none.
  Pose2 odometry;
  Pose2 before = moments.front().odom_from_robot;
  for (LabelledOdometry& moment : moments) {
    const Pose2 step = inverse(before) * moment.odom_from_robot;
    before = moment.odom_from_robot;
    odometry = odometry * Pose2{1.02 * step.x, step.y, step.theta + Angle::degrees(step.x)};
    moment.odom_from_robot = odometry;
  }
  const auto fit = fit_odometry_model(windows_of(moments), {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->drift_turn, -std::numbers::pi / 180.0 / 1.02, 0.003);
  EXPECT_NEAR(fit->drift_length, -0.02, 0.008);
}

TEST(OdometryFit, KeepsWhatTheDriveDoesNotShow) {
  Rng rng{6};
  const LabelledMotionNoise truth;
  std::vector<LabelledOdometry> straight;
  for (int i = 0; i < 1500; ++i)
    straight.push_back({{0.25 * i, 0.0, {}}, {0.25 * i + rng.normal(0.0, 0.03), rng.normal(0.0, 0.03), {}}, true});
  const auto fit = fit_odometry_model(windows_of(straight), truth);
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_EQ(fit->noise.motion.rotation_per_radian, truth.motion.rotation_per_radian);
  EXPECT_LT(fit->noise.motion.translation_per_metre, 0.0005) << "the labels' noise is not odometry's";
  EXPECT_NEAR(std::sqrt(fit->noise.label_position), 0.03, 0.006);

  for (LabelledOdometry& moment : straight) moment.sure = false;
  const auto nothing = fit_odometry_model(windows_of(straight), truth);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message, "too little motion with a known place: 0 windows, 0 m");
}

}  // namespace
}  // namespace docent::motion_models
