#include "docent/apps/localize/localize_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace docent::apps::localize_command {
namespace {

using nlohmann::json;

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(LocalizeSummary, TellsWhenItKnewAndHowWell) {
  const std::string text =
      summary_of_run({{"scans", 713},
                      {"updates", 140},
                      {"localized_after_scans", 56},
                      {"localized_fraction", 0.882},
                      {"in_hindsight_fraction", 0.061},
                      {"taken_back_fraction", 0.004},
                      {"endpoints_near_walls", 0.901},
                      {"reference_scans", 700},
                      {"mean_error_m", 0.056},
                      {"p95_error_m", 0.12},
                      {"max_error_m", 1.5},
                      {"lost_scans", 3},
                      {"lost_fraction", 3.0 / 700.0},
                      {"in_hindsight", {{"reference_scans", 705}, {"mean_error_m", 0.043}, {"lost_scans", 1}}}});
  EXPECT_TRUE(says(text, "713 scans, 140 of them")) << text;
  EXPECT_TRUE(says(text, "after 56 scans")) << text;
  EXPECT_TRUE(says(text, "88.2 %")) << text;
  EXPECT_TRUE(says(text, "another 6.1 %, and takes back 0.4 %")) << text;
  EXPECT_TRUE(says(text, "mean error 5.6 cm")) << text;
  EXPECT_TRUE(says(text, "at most 1.50 m")) << text;
  EXPECT_TRUE(says(text, "lost in 3 scans (0.4 %)")) << text;
  EXPECT_TRUE(says(text, "in hindsight, 705 scans: mean error 4.3 cm")) << text;
}

TEST(LocalizeSummary, ARobotThatNeverKnewHasNothingElseToTell) {
  const std::string text = summary_of_run({{"scans", 5}, {"updates", 2}, {"localized_after_scans", nullptr}});
  EXPECT_TRUE(says(text, "never said")) << text;
  EXPECT_FALSE(says(text, "readings")) << text;
  EXPECT_FALSE(says(text, "reference")) << text;
}

TEST(LocalizeSummary, AgreementOfNothingIsNoAgreement) {
  EXPECT_TRUE(says(summary_of_agreement({{"scans", 10}, {"both_know", 0}}), "nothing to compare"));
  EXPECT_TRUE(says(summary_of_agreement({{"both_know", 1406},
                                         {"within_half_a_metre_and_10_degrees", 1.0},
                                         {"median_m", 0.02},
                                         {"p95_m", 0.1},
                                         {"max_m", 0.3}}),
                   "in 100.0 % of 1406 scans; 2.0 cm in the median"));
  EXPECT_TRUE(
      says(summary_of_agreement({{"both_know", 90},
                                 {"there_and_then", {{"both_know", 40}, {"within_half_a_metre_and_10_degrees", 0.9}}}}),
           "there and then in 90.0 % of the 40 scans"));
}

}  // namespace
}  // namespace docent::apps::localize_command
