#include <gtest/gtest.h>

#include <cmath>

#include "docent/simulator/world/survey.h"
#include "sonar_trial.h"

namespace docent {
namespace {

TEST(SonarTracking, KeepsTrackInOfficesWhereDeadReckoningIsLost) {
  for (const std::uint64_t seed : {101U, 102U, 103U}) {
    SonarTrialOptions options;
    options.seed = seed;
    options.minutes = 6.0;
    const SonarTrialResult whole = run_trial(options);
    EXPECT_GT(whole.drive.metres, 60.0) << seed;
    EXPECT_LT(whole.p95_error, 0.30) << seed;
    EXPECT_LT(whole.max_error, 0.60) << seed;
    options.tracker.use_walls = options.tracker.use_matches = false;
    const SonarTrialResult crippled = run_trial(options);
    EXPECT_GT(crippled.max_error, 0.60) << seed;
    EXPECT_EQ(crippled.drive.metres, whole.drive.metres) << "the same drive";
  }
}

TEST(SonarTracking, TheMapOfABuildingSaysHowItIsTurned) {
  double sum = 0.0;
  for (std::uint64_t seed = 101; seed <= 130; ++seed) {
    const simulator::Office office = simulator::draw_office(seed);
    const localization::EchoMap map{simulator::survey(office.world, {}, Rng{seed}).map};
    const double turn = direction(office.world.floor[0], office.world.floor[1]).degrees();
    ASSERT_TRUE(map.main_direction());
    const double off = std::remainder(map.main_direction()->heading.degrees() - turn, 90.0);
    EXPECT_LT(std::abs(off), 0.4) << seed;
    EXPECT_GT(map.main_direction()->share, 0.55) << seed;
    sum += std::abs(off) / 30.0;
  }
  EXPECT_LT(sum, 0.1);
}

}  // namespace
}  // namespace docent
