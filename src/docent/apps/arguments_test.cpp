#include "docent/apps/arguments.h"

#include <gtest/gtest.h>

#include "docent/apps/command.h"

namespace docent {
namespace {

TEST(Arguments, NumbersWithCommas) {
  EXPECT_EQ(parse_point("--from", "1.5,-2"), (Point2{1.5, -2.0}));
  EXPECT_NEAR(parse_pose("--start", "0,0,90").theta.degrees(), 90.0, 1e-9);
}

TEST(Arguments, AnythingElseIsRefusedByName) {
  for (const char* text : {"", "1", "1,2,3", "1,x", "1,2,", "nan,1", "1 2", "inf,0"}) {
    try {
      (void)parse_point("--from", text);
      ADD_FAILURE() << "'" << text << "' was taken";
    } catch (const CommandFailed& failure) {
      EXPECT_TRUE(failure.message.starts_with("--from ")) << failure.message;
      EXPECT_EQ(failure.exit_code, 2);
    }
  }
}

}  // namespace
}  // namespace docent
