#include "docent/apps/doctor/findings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace docent::apps::doctor_command {
namespace {

const std::vector<Finding> kSome{{"files", "museum", Verdict::fine, "3 exhibits"},
                                 {"base", "odom", Verdict::wrong, "nobody publishes it", {{"rate_hz", 0.0}}},
                                 {"base", "scan", Verdict::note, "7.5 Hz"}};

TEST(Findings, ThePageHasALineEachUnderItsSection) {
  EXPECT_EQ(
      page_of(kSome),
      "files\n  fine   museum  3 exhibits\n\nbase\n  WRONG  odom    nobody publishes it\n  note   scan    7.5 Hz\n\n"
      "1 fine, 1 to note, 1 wrong\n");
  EXPECT_EQ(worst_of(kSome), Verdict::wrong);
  EXPECT_EQ(worst_of({}), Verdict::fine);
}

TEST(Findings, ProgramsReadTheSame) {
  const auto all = nlohmann::json::parse(json_of(kSome));
  EXPECT_EQ(all["verdict"], "wrong");
  ASSERT_EQ(all["findings"].size(), 3U);
  EXPECT_EQ(all["findings"][1]["name"], "odom");
  EXPECT_EQ(all["findings"][1]["figures"]["rate_hz"], 0.0);
  EXPECT_NO_THROW(static_cast<void>(json_of({{"base", "scan", Verdict::note, "frame \xff"}}))) << "bytes of a stranger";
}

}  // namespace
}  // namespace docent::apps::doctor_command
