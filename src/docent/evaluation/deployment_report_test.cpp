#include "docent/evaluation/deployment_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace docent::evaluation {
namespace {

TEST(DeploymentReport, JsonHasTheKeysOfTheArchitectureInTheirOrder) {
  DeploymentReport report;
  report.museum = "bonn";
  report.requests.refused = {{"closed", 2}};
  report.virtual_seconds = 3.5;
  const auto json = nlohmann::ordered_json::parse(to_json(report, RunCost{2.0, 1.75, {{"plan", 1.5}}}));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"museum",
                                            "mode",
                                            "seed",
                                            "crowd",
                                            "config_hash",
                                            "simd",
                                            "crippled",
                                            "virtual_seconds",
                                            "wall_seconds",
                                            "cpu_seconds",
                                            "speedup",
                                            "wall_speedup",
                                            "travel_seconds",
                                            "standing_seconds",
                                            "distance_m",
                                            "mean_speed_mps",
                                            "max_speed_mps",
                                            "requests",
                                            "success_rate",
                                            "tours",
                                            "exhibits_explained",
                                            "explained_in_wrong_place",
                                            "plan_revisions",
                                            "attraction_trials",
                                            "visitors",
                                            "web_visitors",
                                            "contacts",
                                            "bumped_by_people",
                                            "contact_seconds_wheels_turning",
                                            "area_violations",
                                            "passes_within_1m",
                                            "localization",
                                            "people",
                                            "blocked",
                                            "battery",
                                            "module_restarts",
                                            "trips",
                                            "p99_ms"}));
  EXPECT_EQ(json["requests"]["refused"]["closed"], 2);
  EXPECT_TRUE(json["success_rate"].is_null());
  EXPECT_TRUE(json["localization"]["localized_after_s"].is_null());
  EXPECT_EQ(json["p99_ms"]["plan"], 1.5);
  EXPECT_EQ(json["cpu_seconds"], 1.75);
  EXPECT_EQ(json["speedup"], 2.0) << "by what one core had to do, whatever else the machine did";
  EXPECT_EQ(json["wall_speedup"], 1.75);
  EXPECT_FALSE(nlohmann::json::parse(to_json(report, std::nullopt)).contains("wall_seconds"));
}

}  // namespace
}  // namespace docent::evaluation
