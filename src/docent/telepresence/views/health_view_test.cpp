#include "docent/telepresence/views/health_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

docent_msgs::Health health(const std::string& module) {
  docent_msgs::Health health;
  health.module = module;
  health.state = "ready";
  return health;
}

TEST(HealthView, ShowsWhatEachModuleSaidLast) {
  const Time now = time_from_seconds(100.0);
  HealthView view;
  EXPECT_EQ(Json::parse(view.document())["modules"].size(), 0U);
  view.see(health("avoid"), now);
  view.see(health("plan"), now);
  view.see(health("avoid"), now);
  EXPECT_EQ(Json::parse(view.document())["modules"].size(), 0U) << "not shown yet";
  const std::string shown = view.show(3, now);
  EXPECT_EQ(view.document(), shown);
  EXPECT_EQ(Json::parse(shown)["modules"].size(), 2U);
  EXPECT_EQ(Json::parse(shown)["viewers"], 3);
}

TEST(HealthView, WhoeverInventsNamesDoesNotFillTheMemory) {
  const Time now = time_from_seconds(100.0);
  HealthView view;
  for (int i = 0; i < 1000; ++i) view.see(health("module" + std::to_string(i)), now);
  EXPECT_EQ(Json::parse(view.show(0, now))["modules"].size(), 64U);
}

TEST(HealthView, MetricsAreALineEach) {
  WebServerFigures figures;
  figures.viewers = 3;
  figures.messages_refused = 7;
  const std::string text = metrics_text(figures);
  EXPECT_NE(text.find("docent_web_viewers 3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("docent_web_messages_refused_total 7\n"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 8);
}

}  // namespace
}  // namespace docent::telepresence
