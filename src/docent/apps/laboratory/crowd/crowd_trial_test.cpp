#include "docent/apps/laboratory/crowd/crowd_trial.h"

#include <gtest/gtest.h>

#include "docent/apps/laboratory/ablations/crippled_robot.h"

namespace docent::apps::crowd_command {
namespace {

CrowdTrialOptions short_trial(double density) {
  CrowdTrialOptions options;
  options.density = density;
  options.settle_s = 3.0;
  options.limit_s = 40.0;
  return options;
}

CrowdTrialOutcome outcome_of(const CrowdTrialOptions& options) {
  auto outcome = run_crowd_trial(options);
  EXPECT_TRUE(outcome) << (outcome ? "" : outcome.error().message);
  return outcome ? std::move(*outcome) : CrowdTrialOutcome{};
}

int contacts_of(const CrowdTrialOutcome& outcome) {
  int sum = 0;
  for (const auto& [kind, count] : outcome.report.contacts) sum += count;
  return sum;
}

TEST(CrowdTrial, AnEmptyHallIsCrossedAtOnce) {
  const auto outcome = outcome_of(short_trial(0.0));
  EXPECT_EQ(outcome.people, 0);
  EXPECT_TRUE(outcome.report.arrived);
  EXPECT_GT(outcome.report.path_m, 10.0);
  EXPECT_LT(outcome.report.path_m, 12.5);
  EXPECT_LT(outcome.report.seconds, 30.0);
  EXPECT_EQ(outcome.report.density_met, 0.0);
  EXPECT_EQ(contacts_of(outcome), 0);
  EXPECT_GT(outcome.moments.size(), 10U);
}

TEST(CrowdTrial, TheSameSeedIsTheSameTrialAndTheMethodDrawsNothing) {
  CrowdTrialOptions options = short_trial(0.4);
  options.limit_s = 12.0;
  const auto first = outcome_of(options);
  const auto second = outcome_of(options);
  EXPECT_EQ(first.report.path_m, second.report.path_m);
  EXPECT_EQ(first.report.mean_closest_m, second.report.mean_closest_m);
  EXPECT_NEAR(first.people / first.free_area, 0.4, 0.01);
  EXPECT_GT(first.report.density_met, 0.0);
  options.settings = {"avoid.method=dynamic_window"};
  const auto other = outcome_of(options);
  EXPECT_EQ(other.people, first.people);
  EXPECT_NE(other.config_hash, first.config_hash);
  ASSERT_FALSE(other.moments.empty());
  for (std::size_t i = 0; i < first.moments.front().people.size(); ++i) {
    EXPECT_NEAR(other.moments.front().people[i].x, first.moments.front().people[i].x, 0.1);
  }
}

TEST(CrowdTrial, ARobotThatSeesNobodyPushes) {
  CrowdTrialOptions options = short_trial(0.8);
  options.settings = {"evaluation.blind_to_people=true"};
  options.robot_maker = std::make_shared<ablations::CrippledRobot>();
  options.ignoring = 1.0;
  int contacts = 0;
  for (options.seed = 1; options.seed <= 3; ++options.seed) contacts += contacts_of(outcome_of(options));
  EXPECT_GT(contacts, 0);
}

TEST(CrowdTrial, AnUnknownSettingIsAnError) {
  CrowdTrialOptions options = short_trial(0.0);
  options.settings = {"avoid.wings=2"};
  const auto outcome = run_crowd_trial(options);
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.error().message.find("wings"), std::string::npos);
}

}  // namespace
}  // namespace docent::apps::crowd_command
