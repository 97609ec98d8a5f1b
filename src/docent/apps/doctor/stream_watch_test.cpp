#include "docent/apps/doctor/stream_watch.h"

#include <gtest/gtest.h>

namespace docent::apps::doctor_command {
namespace {

Time at(double s) { return time_from_seconds(1000.0 + s); }

Finding judged(const StreamWatch& watch, int writers = 1, StreamDemand demand = {.least_hz = 8.0, .silent_s = 0.5}) {
  return watch.judge("scan", demand, writers, at(0.0), at(5.0));
}
/// For five seconds, each so old.
StreamWatch steady(double hz, double age) {
  StreamWatch watch;
  for (double s = 0.01; s < 5.0; s += 1.0 / hz) watch.hear(at(s - age), at(s), "laser");
  return watch;
}

TEST(StreamWatch, WhatComesSteadilyIsFine) {
  const Finding finding = judged(steady(10.0, 0.03));
  EXPECT_EQ(finding.verdict, Verdict::fine);
  EXPECT_EQ(finding.text, "10.0 Hz; 30 ms old");
}

TEST(StreamWatch, WhatDoesNotComeIsToldWithWhy) {
  EXPECT_EQ(judged({}, 0).text, "nobody publishes it");
  EXPECT_EQ(judged({}, 0).verdict, Verdict::wrong);
  EXPECT_NE(judged({}, 1).text.find("of another type"), std::string::npos);
  EXPECT_EQ(judged({}, 0, {.is_required = false}).verdict, Verdict::note);
}

TEST(StreamWatch, SlowSilentLateAndAheadAreNamed) {
  EXPECT_EQ(judged(steady(4.0, 0.0)).verdict, Verdict::wrong);
  EXPECT_NE(judged(steady(4.0, 0.0)).text.find("wanted are 8.0 Hz at least"), std::string::npos);
  StreamWatch stopped;
  for (double s = 0.01; s < 3.0; s += 0.1) stopped.hear(at(s), at(s), "");
  EXPECT_NE(judged(stopped).text.find("silent for 2.1 s"), std::string::npos);
  EXPECT_NE(judged(steady(10.0, 0.4)).text.find("clock is behind"), std::string::npos);
  EXPECT_EQ(judged(steady(10.0, 0.4)).verdict, Verdict::note);
  EXPECT_NE(judged(steady(10.0, -0.4)).text.find("ahead of this one's"), std::string::npos);
  EXPECT_NE(judged(steady(10.0, 900000.0)).text.find("of another clock"), std::string::npos);
}

TEST(StreamWatch, OddStampsAreNamed) {
  StreamWatch zero;
  StreamWatch same;
  StreamWatch back;
  for (int i = 0; i < 50; ++i) {
    const double s = 0.1 * i;
    zero.hear({}, at(s), "");
    same.hear(at(0.0), at(s), "");
    back.hear(at(i % 10 == 9 ? s - 0.15 : s), at(s), "");
  }
  EXPECT_NE(judged(zero).text.find("its stamps are zero"), std::string::npos);
  EXPECT_NE(judged(same).text.find("it repeats its stamps"), std::string::npos);
  EXPECT_NE(judged(back).text.find("5 stamps lie before the one before"), std::string::npos);
  EXPECT_NE(judged(steady(10.0, 0.0), 2).text.find("2 programs publish it"), std::string::npos);
}

}  // namespace
}  // namespace docent::apps::doctor_command
