#include "docent/telepresence/views/inside_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

docent_msgs::Event event(const std::string& subject) {
  docent_msgs::Event event;
  event.header.stamp = to_message(time_from_seconds(12.5));
  event.kind = "arrived";
  event.subject = subject;
  return event;
}

TEST(InsideView, TheLogHasTheNewestFirstAndNoMoreThanSixtyLines) {
  InsideView view;
  EXPECT_TRUE(view.log()) << "an empty log is shown, too";
  EXPECT_FALSE(view.log());
  for (int i = 0; i < 70; ++i) view.see(event(std::to_string(i)));
  const auto text = view.log();
  ASSERT_TRUE(text);
  const Json lines = Json::parse(*text)["lines"];
  ASSERT_EQ(lines.size(), 60U);
  EXPECT_NE(lines.front().dump().find("\"69\""), std::string::npos) << lines.front().dump();
  EXPECT_NE(lines.back().dump().find("\"10\""), std::string::npos) << lines.back().dump();
  EXPECT_FALSE(view.log()) << "nothing is new";
}

TEST(InsideView, AFieldThatIsOldIsEmpty) {
  const Time now = time_from_seconds(100.0);
  InsideView view;
  const std::string empty = view.field(now);
  sensor_msgs::LaserScan scan;
  scan.header.stamp = to_message(now);
  scan.angle_increment = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges = {1.0F, 2.0F};
  view.see(scan);
  EXPECT_NE(view.field(now + seconds(1.9)), empty);
  EXPECT_EQ(view.field(now + seconds(2.1)), empty);
}

}  // namespace
}  // namespace docent::telepresence
