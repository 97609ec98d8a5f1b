#include "docent/collision_avoidance/plausibility/repeated_sweeps.h"

#include <gtest/gtest.h>

#include <vector>

#include "docent/base/random.h"

namespace docent::collision_avoidance::repeated_sweeps_test {
namespace {

std::vector<float> noisy(Rng& rng) {
  std::vector<float> ranges;
  for (int i = 0; i < 180; ++i) ranges.push_back(static_cast<float>(rng.uniform(1.0, 4.0)));
  return ranges;
}

/// 30 sweeps; the robot drives 0.05 m between two of them.
struct Drive {
  RepeatedSweeps watch;
  Rng rng{1};
  std::vector<std::vector<float>> given;
  std::optional<double> give(const std::vector<float>& ranges, double step = 0.05, int answers = 180) {
    given.push_back(ranges);
    x += step;
    return watch.add(time_from_seconds(1.0 + 0.1 * static_cast<double>(given.size())), ranges, answers, {x, 0.0, {}});
  }
  double x = 0.0;
};

TEST(RepeatedSweeps, FindsOldSweepsWithNewStamps) {
  Drive drive;
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(drive.give(noisy(drive.rng)));
  EXPECT_FALSE(drive.give(drive.given[20]));  // once may be chance
  const auto age = drive.give(drive.given[21]);
  ASSERT_TRUE(age);
  EXPECT_NEAR(*age, 1.0, 0.01);
  EXPECT_FALSE(drive.give(noisy(drive.rng)));
}

TEST(RepeatedSweeps, ARobotAtRestProvesNothingAndNeitherDoesAnEmptySweep) {
  Drive drive;
  const std::vector<float> same = noisy(drive.rng);
  const std::vector<float> other = noisy(drive.rng);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(drive.give(i % 2 == 0 ? same : other, 0.0));
  const std::vector<float> nothing(180, 10.0F);
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(drive.give(i % 2 == 0 ? nothing : noisy(drive.rng), 0.05, 0));
}

}  // namespace
}  // namespace docent::collision_avoidance::repeated_sweeps_test
