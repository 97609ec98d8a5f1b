#include "docent/apps/laboratory/ablations/ablations.h"

#include <gtest/gtest.h>

#include <numbers>

#include "docent/collision_avoidance/avoider/avoider_params.h"
#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"
#include "docent/interaction/attract/attraction.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/localization/sonar/evidence/sonar_evidence.h"
#include "docent/mapping/occupancy/live_map.h"
#include "docent/people/people_finder.h"
#include "docent/task_control/golex/executive_params.h"
#include "docent/task_control/golog_planner/golog_planner.h"
#include "docent/task_control/mission/mission.h"
#include "docent/telepresence/store/store_queue.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::ablations {
namespace {

template <class Part>
Part amended(const AblationParams& params, Part part = {}) {
  amendments_of(params).apply(part);
  return part;
}

TEST(Ablations, WithoutASwitchEveryPartIsAsARobotHasIt) {
  const AblationParams none;
  const auto avoider = amended<collision_avoidance::AvoiderParams>(none);
  EXPECT_TRUE(avoider.watches && !avoider.blind_to_people && avoider.remembers_touch);
  EXPECT_GT(amended<mapping::LiveMapParams>(none).touch.forget, 60.0);
  EXPECT_GT(amended<task_control::StaffCallParams>(none).call_below, 0.1);
  EXPECT_FALSE(amended<collision_avoidance::VirtualMeasurementParams>(none).best_pose_only);
  EXPECT_FALSE(amended<localization::LocalizerParams>(none).reckons_dead);
  EXPECT_FALSE(amended<localization::SonarEvidenceParams>(none).trusting);
  EXPECT_FALSE(amended<people::PeopleFinderParams>(none).keeps_all);
  const auto executive = amended<task_control::ExecutiveParams>(none);
  EXPECT_TRUE(executive.ladder.active && executive.ladder.asks);
  EXPECT_FALSE(amended<telepresence::StoreQueueParams>(none).at_once);
  EXPECT_EQ(executive.max_drive_s, task_control::ExecutiveParams{}.max_drive_s);
  EXPECT_TRUE(amended<task_control::SchedulerParams>(none).by_travel);
  EXPECT_TRUE(amended<task_control::GologPlannerParams>(none).has_stand_in);
  task_control::MissionMemory memory;
  memory.must_charge = true;
  EXPECT_TRUE(amended(none, memory).must_charge);
  for (const char* module : {"avoid", "hazards", "plan", "localize", "mission", "executive", "head", "people"}) {
    EXPECT_TRUE(alterations_of(none, module).empty()) << module;
    EXPECT_FALSE(ignores_hazards(none, module)) << module;
  }
}

TEST(Ablations, ASwitchChangesItsParameter) {
  AblationParams params;
  params.blind_to_people = params.without_watches = params.best_pose_only = params.dead_reckoning = true;
  params.misses_carrying = params.doubts_odometry = params.trusts_dead_sonars = params.keeps_all_people =
      params.without_ladder = params.without_moods = true;
  params.never_gives_up = params.serves_by_arrival = params.without_stand_in = true;
  params.forgets_touch = params.calls_nobody = true;
  EXPECT_LT(amended<mapping::LiveMapParams>(params).touch.forget, 1.0);
  const auto staff = amended<task_control::StaffCallParams>(params);
  EXPECT_TRUE(staff.call_below == 0.0 && staff.trouble_tries > 1000 && staff.way_tries > 1000);
  params.never_explores = params.ignores_reward = params.stores_at_once = true;
  EXPECT_TRUE(amended<telepresence::StoreQueueParams>(params).at_once);
  const auto avoider = amended<collision_avoidance::AvoiderParams>(params);
  EXPECT_TRUE(!avoider.watches && avoider.blind_to_people && !avoider.remembers_touch &&
              !avoider.stops_when_carried_off);
  EXPECT_EQ(avoider.odometry.margin, 0.0);
  EXPECT_TRUE(amended<collision_avoidance::VirtualMeasurementParams>(params).best_pose_only);
  EXPECT_TRUE(amended<localization::LocalizerParams>(params).reckons_dead);
  EXPECT_TRUE(amended<localization::SonarEvidenceParams>(params).trusting);
  EXPECT_TRUE(amended<people::PeopleFinderParams>(params).keeps_all);
  const auto executive = amended<task_control::ExecutiveParams>(params);
  EXPECT_FALSE(executive.ladder.active || executive.ladder.asks);
  EXPECT_GT(executive.max_drive_s, 1e7);
  EXPECT_GT(executive.ladder.patience_s, 1e7);
  EXPECT_FALSE(amended<task_control::SchedulerParams>(params).by_travel);
  EXPECT_FALSE(amended<task_control::GologPlannerParams>(params).has_stand_in);
  const auto learner = amended<interaction::AttractionParams>(params);
  EXPECT_TRUE(learner.choice.never_explores && learner.ignores_reward);
}

TEST(Ablations, AMissionForgetsItsTaskOrAlsoItsRequests) {
  task_control::MissionMemory memory;
  memory.must_charge = true;
  memory.planner = "plan";
  memory.next_task = 7;
  memory.schedule.visit.emplace();
  AblationParams tasks;
  tasks.forgets_tasks = true;
  const auto without_task = amended(tasks, memory);
  EXPECT_FALSE(without_task.must_charge || without_task.schedule.visit);
  EXPECT_EQ(without_task.planner, "");
  EXPECT_EQ(without_task.next_task, 7U) << "ids do not come again";
  AblationParams requests;
  requests.forgets_requests = true;
  const auto without_requests = amended(requests, memory);
  EXPECT_FALSE(without_requests.schedule.visit);
  EXPECT_TRUE(without_requests.must_charge);
}

TEST(Ablations, AMuseumWithoutHazardsIsForThoseWhoPlanWays) {
  museum::Museum museum;
  museum.hazards.emplace_back();
  museum.area = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}};
  museum.home = {1.0, 2.0, {}};
  const museum::Museum without = without_hazards(museum);
  EXPECT_TRUE(without.hazard_polygons().empty());
  EXPECT_TRUE(without.area.empty());
  EXPECT_EQ(without.home.y, 2.0);
  AblationParams params;
  params.ignores_hazards = true;
  EXPECT_TRUE(ignores_hazards(params, "plan"));
  EXPECT_TRUE(ignores_hazards(params, "explore"));
  EXPECT_FALSE(ignores_hazards(params, "avoid"));
}

/// A module that says and hears one message on an altered bus.
class AlteredModule : public ::testing::Test {
 protected:
  template <class T>
  T said(const char* module, const Topic<T>& topic, const T& message) {
    AlteredBus altered{hub.connect(module), alterations_of(params, module)};
    T seen;
    other->subscribe<T>(topic, [&seen](const T& one) { seen = one; });
    altered.publisher(topic).publish(message);
    hub.run_until(hub.now() + seconds(0.1));
    return seen;
  }
  template <class T>
  std::optional<T> heard(const char* module, const Topic<T>& topic, const T& message) {
    AlteredBus altered{hub.connect(module), alterations_of(params, module)};
    std::optional<T> seen;
    altered.subscribe<T>(topic, [&seen](const T& one) { seen = one; });
    other->publisher(topic).publish(message);
    hub.run_until(hub.now() + seconds(0.1));
    return seen;
  }

  transport::VirtualTimeHub hub;
  std::unique_ptr<transport::Bus> other = hub.connect("other");
  AblationParams params;
};

TEST_F(AlteredModule, TheBestPoseIsOffAndNoOther) {
  params.best_pose_error_x = 1.0;
  params.best_pose_error_heading = 90.0;
  docent_msgs::Belief belief;
  belief.hypotheses.resize(2);
  belief.hypotheses[0].x = belief.hypotheses[1].x = 3.0;
  belief.hypotheses[0].mass = belief.hypotheses[1].mass = 0.5;
  const auto told = said("localize", topics::kBelief, belief);
  ASSERT_EQ(told.hypotheses.size(), 2U);
  EXPECT_EQ(told.hypotheses[0].x, 4.0);
  EXPECT_NEAR(told.hypotheses[0].theta, std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ(told.hypotheses[1].x, 3.0);
}

TEST_F(AlteredModule, NoHazardIsNear) {
  params.ignores_hazards = true;
  sensor_msgs::LaserScan scan;
  scan.range_max = 5.0F;
  scan.angle_min = -std::numbers::pi_v<float>;
  scan.angle_increment = std::numbers::pi_v<float>;
  scan.ranges = {1.0F, 2.0F, 3.0F, 4.0F};  // twice round
  EXPECT_EQ(said("hazards", topics::kVirtualScan, scan).ranges, (std::vector<float>(4, 5.0F)));
}

TEST_F(AlteredModule, WhateverStandsOnTheChargerIsSomebody) {
  params.takes_things_for_people = true;
  docent_msgs::GoalState state;
  state.occupied = true;
  EXPECT_FALSE(heard("executive", topics::kGoalState, state)->occupied);
  EXPECT_TRUE(heard("web", topics::kGoalState, state)->occupied);
}

TEST_F(AlteredModule, TheFaceIsNeutralAndLooksAsBefore) {
  params.without_moods = true;
  docent_msgs::Expression angry;
  angry.mood = "angry";
  angry.valence = -1.0;
  angry.gaze = "person";
  const auto face = said("head", topics::kExpression, angry);
  EXPECT_EQ(face.mood, "neutral");
  EXPECT_EQ(face.valence, 0.0);
  EXPECT_EQ(face.gaze, "person");
}

TEST_F(AlteredModule, NothingStandsInTheLiveMapOfWhoPlans) {
  params.ignores_live_map = true;
  docent_msgs::LiveMapUpdate update;
  update.width = 2;
  update.height = 1;
  update.data = {100, -1};
  const auto known = heard("plan", topics::kLiveMapUpdate, update);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->data, (std::vector<std::int8_t>{0, 0}));
  EXPECT_EQ(heard("web", topics::kLiveMapUpdate, update)->data, update.data);
}

TEST_F(AlteredModule, AMissionHearsNothingOfItsBattery) {
  params.without_battery_watch = true;
  sensor_msgs::BatteryState battery;
  battery.present = true;
  battery.percentage = 0.5F;
  EXPECT_FALSE(heard("mission", topics::kBattery, battery));
  EXPECT_TRUE(heard("web", topics::kBattery, battery));
}

}  // namespace
}  // namespace docent::apps::ablations
