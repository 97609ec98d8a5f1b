#include "docent/apps/shared/arguments.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "docent/apps/shared/command.h"

namespace docent::apps {
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

TEST(Arguments, APictureIsRefusedBeforeTheWorkByItsExtension) {
  for (const char* good : {"a.svg", "a.pdf", "a.png", "/tmp/b.c.svg"}) {
    std::string text = good;
    EXPECT_EQ(output_picture()(text), "") << good;
  }
  for (const char* bad : {"a.jpg", "a", "svg", "a.svg.gz", ""}) {
    std::string text = bad;
    EXPECT_NE(output_picture()(text).find("must end in .svg, .pdf or .png"), std::string::npos) << bad;
  }
  std::string nowhere = "/nowhere/a.svg";
  EXPECT_NE(output_picture()(nowhere).find("there is no folder /nowhere"), std::string::npos);
}

}  // namespace
}  // namespace docent::apps
