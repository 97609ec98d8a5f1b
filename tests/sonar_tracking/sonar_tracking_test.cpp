#include <gtest/gtest.h>

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

}  // namespace
}  // namespace docent
