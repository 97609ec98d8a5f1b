#include "docent/transport/reader_watch.h"

#include <gtest/gtest.h>

namespace docent::transport::reader_watch_test {
namespace {

using Clock = ReaderWatch::Clock;

Clock::time_point at(double seconds) {
  return Clock::time_point{} + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>{seconds});
}

/// Ten messages a second for five seconds.
ReaderWatch regular() {
  ReaderWatch watch;
  for (int i = 0; i <= 50; ++i) watch.hear(at(0.1 * i));
  return watch;
}

TEST(ReaderWatch, WhoHearsNothingWhileTheWriterLivesIsDeaf) {
  ReaderWatch watch = regular();
  EXPECT_FALSE(watch.is_deaf(at(6.0), true));
  EXPECT_TRUE(watch.is_deaf(at(7.5), true));
  EXPECT_FALSE(watch.is_deaf(at(8.5), true)) << "the new reader has its time";
  EXPECT_TRUE(watch.is_deaf(at(11.5), true));
}

TEST(ReaderWatch, AWriterThatIsGoneIsSilentForGood) {
  ReaderWatch watch = regular();
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(watch.is_deaf(at(6.0 + i), false));
}

TEST(ReaderWatch, WhatCameSeldomTellsNothing) {
  ReaderWatch watch;
  for (int i = 0; i < 5; ++i) watch.hear(at(0.1 * i));
  EXPECT_FALSE(watch.is_deaf(at(60.0), true));
}

TEST(ReaderWatch, ADriverThatIsSilentForGoodIsAskedEverMoreSeldom) {
  ReaderWatch watch = regular();
  int tries = 0;
  for (int i = 0; i < 3600; ++i) tries += watch.is_deaf(at(5.0 + i), true) ? 1 : 0;
  EXPECT_LE(tries, 70);
  EXPECT_GE(tries, 50);
  watch.hear(at(3700.0));
  EXPECT_FALSE(watch.is_deaf(at(3701.0), true));
}

}  // namespace
}  // namespace docent::transport::reader_watch_test
