#include "docent/telepresence/limits/fair_share.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

const Time kBegin = time_from_seconds(1000.0);

TEST(FairShare, WhoCallsALotLeavesTheOthersTheirs) {
  FairShare line{{.per_second = 50.0, .burst = 10.0}};
  int crowd = 0, honest = 0, asked = 0;
  for (int ms = 0; ms < 60'000; ms += 10) {
    const Time now = kBegin + std::chrono::milliseconds{ms};
    for (int i = 0; i < 20; ++i)
      crowd += line.take("crowd " + std::to_string((ms / 10 * 20 + i) % 200), now);  // 2,000/s
    if (ms % 5000 != 0) continue;
    ++asked;
    honest += line.take("honest", now);
  }
  EXPECT_EQ(honest, asked) << "one word every five seconds";
  EXPECT_LE(crowd + honest, 50 * 60 + 700) << "and three words of each who is new";
  EXPECT_GE(crowd + honest, 50 * 30) << "and most of what the line carries is used";
}

TEST(FairShare, OneAloneHasAll) {
  FairShare line{{.per_second = 50.0, .burst = 10.0}};
  int taken = 0;
  for (int ms = 0; ms < 10'000; ms += 10) taken += line.take("one", kBegin + std::chrono::milliseconds{ms});
  EXPECT_NEAR(taken, 500, 15);
}

TEST(FairShare, WhoIsSilentTakesNoShareAndMemoryIsBounded) {
  FairShare line{{.per_second = 10.0, .burst = 10.0, .most = 100}};
  int newcomers = 0;
  for (int i = 0; i < 1000; ++i) newcomers += line.take(std::to_string(i), kBegin);
  EXPECT_LE(newcomers, 30) << "three seconds worth";
  EXPECT_FALSE(line.take("one more", kBegin + seconds(9.0)));
  EXPECT_TRUE(line.take("one more", kBegin + seconds(11.5)));
  int taken = 0;
  for (int i = 0; i < 100; ++i) taken += line.take("one more", kBegin + seconds(12.0 + 0.1 * i));
  EXPECT_GT(taken, 90) << "the others are forgotten";
}

}  // namespace
}  // namespace docent::telepresence
