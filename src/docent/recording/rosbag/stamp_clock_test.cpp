#include "docent/recording/rosbag/stamp_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace docent::recording {
namespace {

/// 600 messages at 20 Hz, the file's times 3 ms behind; `stamp` sets the i-th stamp [s] after the first time.
std::vector<RecordedStamp> messages(const std::function<double(int, double)>& stamp) {
  std::vector<RecordedStamp> all;
  for (int i = 0; i < 600; ++i) {
    const double at = 0.05 * i;
    all.push_back({time_from_seconds(1.7e9 + stamp(i, at)), time_from_seconds(1.7e9 + at + 0.003)});
  }
  return all;
}
double worst(const MendedStamps& mended, double from = 0.0) {
  double most = 0.0;
  for (std::size_t i = 0; i < mended.times.size(); ++i)
    most = std::max(
        most, std::abs(to_seconds(mended.times[i] - time_from_seconds(1.7e9)) - from - 0.05 * static_cast<double>(i)));
  return most;
}

TEST(StampClock, SoundStampsStay) {
  EXPECT_EQ(mended_stamps({}).times.size(), 0U);
  const auto sound = mended_stamps(messages([](int i, double at) { return at + 0.02 * (i % 3); }));
  EXPECT_EQ(sound.mended, 0U);
  EXPECT_LT(worst(sound), 0.05);
  const auto slow = mended_stamps(messages([](int, double at) { return 0.3 * at - 900.0; }));  // a simulation's
  EXPECT_EQ(slow.mended, 0U);
}

TEST(StampClock, TwoTopicsOfOneClockAreNotApart) {
  const auto sound = messages([](int, double at) { return at; });
  EXPECT_EQ(clock_ahead(sound, sound), Duration{});
  EXPECT_NEAR(to_seconds(clock_ahead(messages([](int, double at) { return at + 3.0; }), sound)), 3.0, 1e-6);
  EXPECT_EQ(clock_ahead({}, sound), Duration{});
  // Five times as fast as the file's, and one of the topics begins late.
  const auto fast = messages([](int, double at) { return 5.0 * at; });
  const std::vector<RecordedStamp> late{fast.begin() + 20, fast.end()};
  EXPECT_LT(std::abs(to_seconds(clock_ahead(late, fast))), 0.01);
  EXPECT_LT(std::abs(to_seconds(clock_ahead(fast, late))), 0.01);
  // A file without times.
  auto untimed = messages([](int, double at) { return at; });
  for (RecordedStamp& one : untimed) one.recorded = {};
  EXPECT_LT(std::abs(to_seconds(clock_ahead(untimed, untimed))), 0.06);
}

TEST(StampClock, AClockThatWasSetFollowsItsLongestStretch) {
  const auto start = mended_stamps(messages([](int i, double at) { return i < 40 ? at - 1.7e9 + 5.0 : at; }));
  EXPECT_EQ(start.mended, 40U);
  EXPECT_LT(worst(start), 1e-5);
  const auto back = mended_stamps(messages([](int i, double at) { return i >= 250 ? at - 30.0 : at; }));
  EXPECT_EQ(back.mended, 250U);
  EXPECT_LT(worst(back, -30.0), 1e-5);
  const auto lone = mended_stamps(messages([](int i, double at) { return i == 300 ? 0.0 - 1.7e9 : at; }));
  EXPECT_EQ(lone.mended, 1U);
  EXPECT_LT(worst(lone), 1e-5);
  const auto wraps = mended_stamps(messages([](int, double at) { return std::fmod(at, 12.0); }));
  EXPECT_LT(std::abs(to_seconds(wraps.times.back() - wraps.times.front()) - 599 * 0.05), 0.01);
}

TEST(StampClock, AStampThatStandsGoesOn) {
  const auto stands = mended_stamps(messages([](int i, double at) { return i >= 200 && i < 260 ? 10.0 : at; }));
  EXPECT_EQ(stands.mended, 59U);
  EXPECT_LT(worst(stands), 1e-5);
  const auto burst = mended_stamps({{Time{5}, Time{5}}, {Time{5}, Time{6}}, {Time{9}, Time{9}}});
  EXPECT_EQ(burst.mended, 0U);
}

TEST(StampClock, TimesOfAFileThatTellNothingMendNothing) {
  std::vector<RecordedStamp> all;
  for (int i = 0; i < 100; ++i) all.push_back({time_from_seconds(100.0 * i), Time{7}});
  EXPECT_EQ(mended_stamps(all).mended, 0U);
}

TEST(StampClock, StampsThatGoBackAndForthAreOfTwoClocks) {
  std::vector<RecordedStamp> stamps;
  for (int i = 0; i < 100; ++i) {
    const Time recorded = time_from_seconds(1000.0 + 0.1 * i);
    stamps.push_back({i % 3 == 0 ? recorded + std::chrono::seconds{2} : recorded, recorded});
  }
  const MendedStamps mended = mended_stamps(stamps);
  EXPECT_EQ(mended.mended, 34U);
  for (std::size_t i = 0; i < stamps.size(); ++i) EXPECT_EQ(mended.times[i], stamps[i].recorded);
  stamps[50].stamp = stamps[20].stamp;  // one that was late is none of another clock
  for (RecordedStamp& one : stamps) one.stamp = one.recorded;
  stamps[50].stamp = stamps[40].stamp;
  EXPECT_EQ(mended_stamps(stamps).mended, 0U);
}

}  // namespace
}  // namespace docent::recording
