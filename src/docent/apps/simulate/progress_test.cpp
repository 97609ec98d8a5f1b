#include "docent/apps/simulate/progress.h"

#include <gtest/gtest.h>

namespace docent::apps::simulate_command {
namespace {

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
}  // namespace docent::apps::simulate_command
