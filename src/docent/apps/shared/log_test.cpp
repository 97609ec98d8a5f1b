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

}  // namespace
}  // namespace docent::apps
