#include "docent/recording/recorded_ranges.h"

#include <gtest/gtest.h>

#include <limits>

namespace docent::recording {
namespace {

std::vector<float> wall(float factor) {
  std::vector<float> ranges;
  for (int i = 0; i < 180; ++i) ranges.push_back(factor * (1.0F + 0.02F * static_cast<float>(i)));
  return ranges;
}

std::string fault_of(const std::vector<float>& ranges, double range_max = 10.0) {
  RecordedRanges recorded;
  for (int i = 0; i < 3; ++i) recorded.add("/scan", ranges, range_max);
  std::vector<std::string> notes;
  const auto judged = recorded.judge(notes);
  EXPECT_TRUE(notes.empty());
  return judged ? "" : judged.error().message;
}

TEST(RecordedRanges, MetresAreFine) {
  EXPECT_EQ(fault_of(wall(1.0F)), "");
  EXPECT_EQ(fault_of(wall(1.0F), 2.0), "");  // most are farther than it reaches
  std::vector<float> few(180, 65.533F);
  few[7] = 3.0F;
  EXPECT_EQ(fault_of(few), "");
}

TEST(RecordedRanges, MillimetresAreNone) {
  EXPECT_EQ(fault_of(wall(1000.0F)),
            "the distances of /scan are not in metres: in 3 scans there are readings like 1000.0 and 1380.0 where "
            "range_max is 10.0");
  EXPECT_EQ(fault_of(wall(1000.0F), 10000.0), "the distances of /scan are not in metres: most are above 100.0");
}

TEST(RecordedRanges, SaysThatNoBeamEndsAnywhere) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float nothing : {kInfinity, 10.0F, 0.0F, 65.533F})
    EXPECT_EQ(fault_of(std::vector<float>(180, nothing)), "no beam of /scan ends anywhere, in 3 scans") << nothing;
}

TEST(RecordedRanges, OneOfTwoLasersIsANote) {
  RecordedRanges recorded;
  recorded.add("/front", wall(1.0F), 10.0);
  recorded.add("/rear", std::vector<float>(180, 10.0F), 10.0);
  std::vector<std::string> notes;
  EXPECT_TRUE(recorded.judge(notes));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "no beam of /rear ends anywhere, in 1 scan");
}

}  // namespace
}  // namespace docent::recording
