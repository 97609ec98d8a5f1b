#include "docent/localization/pose_watch/scan_rounds.h"

#include <gtest/gtest.h>

namespace docent::localization {
namespace {

Time at(double s) { return time_from_seconds(1000.0 + s); }

TEST(ScanRounds, ARoundIsOneScanOfEachLaserWhateverTheirPhase) {
  ScanRounds rounds{2};
  rounds.hear(0, at(0.0));
  EXPECT_FALSE(rounds.is_whole());
  rounds.hear(1, at(0.047));
  ASSERT_TRUE(rounds.is_whole());
  EXPECT_EQ(rounds.whole_since(), at(0.047));
  rounds.close(at(0.05));
  EXPECT_FALSE(rounds.is_whole());
}

TEST(ScanRounds, ALaserThatIsSilentHoldsNobodyUp) {
  ScanRounds rounds{3};
  rounds.hear(0, at(0.0));
  rounds.hear(2, at(0.01));
  EXPECT_FALSE(rounds.is_whole());
  rounds.hear(0, at(0.1));
  EXPECT_TRUE(rounds.is_whole()) << "the second one of the same laser";
}

TEST(ScanRounds, EveryScanOfALaserByItselfIsARound) {
  ScanRounds rounds{1};
  int looks = 0;
  for (int i = 0; i < 100; ++i) {
    rounds.hear(0, at(0.1 * i));
    if (!rounds.is_whole()) continue;
    ++looks;
    rounds.close(at(0.1 * i));
  }
  EXPECT_EQ(looks, 100);
}

TEST(ScanRounds, OfAFastLaserTheNewestScansCount) {
  ScanRounds rounds{1};
  int looks = 0;
  for (int i = 0; i < 400; ++i) {  // 40 Hz for 10 s
    rounds.hear(0, at(0.025 * i));
    if (!rounds.is_whole()) continue;
    EXPECT_EQ(rounds.whole_since(), at(0.025 * i)) << "it looks at the scan that has just come";
    ++looks;
    rounds.close(at(0.025 * i));
  }
  EXPECT_GE(looks, 100);
  EXPECT_LE(looks, 167) << "at most one in 60 ms";
}

TEST(ScanRounds, ABurstAfterAHiccupIsOneLook) {
  ScanRounds rounds{2};
  int looks = 0;
  for (int i = 0; i < 5; ++i) {
    for (const std::size_t laser : {0U, 1U}) rounds.hear(laser, at(0.001 * i));
    if (!rounds.is_whole()) continue;
    ++looks;
    rounds.close(at(0.001 * i));
  }
  EXPECT_EQ(looks, 1);
  rounds.hear(0, at(0.1));
  EXPECT_TRUE(rounds.is_whole()) << "what came within the pause is not lost";
}

TEST(ScanRounds, AClockThatWasSetBackStopsNoLook) {
  ScanRounds rounds{1};
  rounds.hear(0, at(100.0));
  rounds.close(at(100.0));
  rounds.hear(0, at(0.0));
  EXPECT_TRUE(rounds.is_whole());
}

}  // namespace
}  // namespace docent::localization
