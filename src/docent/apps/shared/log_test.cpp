#include "docent/apps/shared/log.h"

#include <gtest/gtest.h>

namespace docent::apps {
namespace {

TEST(Log, ALineCarriesTimeLevelAndModule) {
  const std::string line = log_line(LogLevel::warning, "localize", "no odometry");
  EXPECT_TRUE(is_log_line(line)) << line;
  EXPECT_TRUE(line.ends_with(" warning localize: no odometry")) << line;
  EXPECT_TRUE(log_line(LogLevel::error, "plan", "gone").ends_with(" error plan: gone"));
  EXPECT_TRUE(log_line(LogLevel::info, "web", "open 100 %").ends_with(" info web: open 100 %"));
}

TEST(Log, OtherLinesAreToldApart) {
  for (const char* line : {"", "docent: no such file", "2026-11-24", "terminate called after throwing",
                           "2026-11-24T10:15:02.123 warning x: y"}) {
    EXPECT_FALSE(is_log_line(line)) << line;
  }
}

/// How many lines a run of `length_s` tells, asked every 0.1 s.
int lines_of(Progress progress, double length_s) {
  int lines = 0;
  for (int i = 1; 0.1 * i < length_s; ++i) lines += progress.is_due(0.1 * i / length_s, 0.1 * i) ? 1 : 0;
  return lines;
}

TEST(Progress, ThroughAPipeALineNowAndThen) {
  EXPECT_EQ(lines_of(Progress{false}, 1.5), 0) << "it is soon over";
  EXPECT_EQ(lines_of(Progress{false}, 9.95), 4) << "not within two seconds of each other";
  EXPECT_EQ(lines_of(Progress{false}, 300.05), 9) << "each tenth of the way";
  EXPECT_EQ(lines_of(Progress{false}, 5999.5), 99) << "each minute";
  EXPECT_EQ(Progress{false}.shown("a"), "a\n");
  EXPECT_EQ(Progress{false}.end(), "");
}

TEST(Progress, OnATerminalOneLineThatChanges) {
  EXPECT_EQ(lines_of(Progress{true}, 9.95), 19);
  EXPECT_EQ(Progress{true}.shown("a"), "\ra\033[K");
}

}  // namespace
}  // namespace docent::apps
