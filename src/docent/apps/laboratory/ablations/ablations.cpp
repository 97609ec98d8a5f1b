#include "docent/apps/laboratory/ablations/ablations.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "docent/collision_avoidance/avoider/avoider_params.h"
#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"
#include "docent/interaction/attract/attraction.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/localization/sonar/evidence/sonar_evidence.h"
#include "docent/mapping/occupancy/live_map.h"
#include "docent/messages/topics.h"
#include "docent/people/people_finder.h"
#include "docent/task_control/golex/executive_params.h"
#include "docent/task_control/golog_planner/golog_planner.h"
#include "docent/task_control/mission/mission.h"
#include "docent/task_control/tour_scheduler/scheduler_params.h"
#include "docent/telepresence/store/store_queue.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::apps::ablations {

namespace {

/// A robot that waits for ever for what does not come.
void take_limits(task_control::ExecutiveParams& executive) {
  constexpr double kForEver = 1e8;  // [s]
  executive.max_drive_s = executive.offer_s = executive.approach.patience_s = kForEver;
  executive.ladder.patience_s = executive.ladder.unreachable_patience_s = executive.ladder.thing_patience_s = kForEver;
}

/// A robot that does not know what it was about, but still what people have asked for.
void forget_tasks(task_control::MissionMemory& memory) {
  memory.schedule.visit.reset();
  memory.schedule.tour.reset();
  memory.schedule.farewell.reset();
  memory.task = {};
  memory.must_charge = false;
  memory.planner.clear();
}

void amend_driving(robot::Amendments& amendments, const AblationParams& params) {
  amendments.add<collision_avoidance::AvoiderParams>([params](auto& avoider) {
    avoider.blind_to_people = params.blind_to_people;
    avoider.watches = !params.without_watches;
    avoider.remembers_touch = !params.forgets_touch;
    avoider.stops_when_carried_off = !params.misses_carrying;
    if (params.doubts_odometry) avoider.odometry = {.margin = 0.0, .linear_noise = 0.02, .angular_noise = 0.02};
  });
  amendments.add<mapping::LiveMapParams>([params](auto& map) {
    constexpr double kAtOnce = 0.01;  // [s]
    if (params.forgets_touch) map.touch.forget = kAtOnce;
  });
  amendments.add<collision_avoidance::VirtualMeasurementParams>(
      [params](auto& hazards) { hazards.best_pose_only = params.best_pose_only; });
  amendments.add<localization::LocalizerParams>([params](auto& localizer) {
    localizer.reckons_dead = params.dead_reckoning;
    localizer.cuts_at_reach = !params.ignores_reach;
  });
  amendments.add<localization::SonarEvidenceParams>(
      [params](auto& sonars) { sonars.trusting = params.trusts_dead_sonars; });
  amendments.add<people::PeopleFinderParams>([params](auto& people) { people.keeps_all = params.keeps_all_people; });
}

void amend_guiding(robot::Amendments& amendments, const AblationParams& params) {
  amendments.add<task_control::ExecutiveParams>([params](auto& executive) {
    executive.ladder.active = !params.without_ladder;
    executive.ladder.asks = !params.without_moods;
    if (params.never_gives_up) take_limits(executive);
  });
  amendments.add<task_control::SchedulerParams>(
      [params](auto& scheduler) { scheduler.by_travel = !params.serves_by_arrival; });
  amendments.add<task_control::StaffCallParams>([params](auto& staff) {
    if (!params.calls_nobody) return;
    staff.call_below = staff.trouble_below = 0.0;
    staff.trouble_tries = staff.way_tries = std::numeric_limits<int>::max();
  });
  amendments.add<task_control::GologPlannerParams>(
      [params](auto& planner) { planner.has_stand_in = !params.without_stand_in; });
  amendments.add<task_control::MissionMemory>([params](auto& memory) {
    if (params.forgets_requests) memory.schedule = {};
    if (params.forgets_tasks) forget_tasks(memory);
  });
  amendments.add<telepresence::StoreQueueParams>([params](auto& queue) { queue.at_once = params.stores_at_once; });
  amendments.add<interaction::AttractionParams>([params](auto& learner) {
    learner.choice.never_explores = params.never_explores;
    learner.ignores_reward = params.ignores_reward;
  });
}

docent_msgs::Belief with_error(docent_msgs::Belief belief, const AblationParams& params) {
  if (belief.hypotheses.empty()) return belief;
  auto& best = belief.hypotheses.front();
  best.x += params.best_pose_error_x;
  best.y += params.best_pose_error_y;
  best.theta += params.best_pose_error_heading * std::numbers::pi / 180.0;
  return belief;
}

/// A map, or a piece of one, in which nothing stands.
template <class Map>
Map emptied(Map map) {
  std::fill(map.data.begin(), map.data.end(), 0);
  return map;
}

}  // namespace

robot::Amendments amendments_of(const AblationParams& params) {
  robot::Amendments amendments;
  amend_driving(amendments, params);
  amend_guiding(amendments, params);
  return amendments;
}

BusAlterations alterations_of(const AblationParams& params, std::string_view module) {
  BusAlterations alterations;
  const bool has_error =
      params.best_pose_error_x != 0.0 || params.best_pose_error_y != 0.0 || params.best_pose_error_heading != 0.0;
  if (module == "localize" && has_error)
    alterations.said<docent_msgs::Belief>(topics::kBelief,
                                          [params](const auto& belief) { return with_error(belief, params); });
  if (module == "hazards" && params.ignores_hazards)
    alterations.said<sensor_msgs::LaserScan>(topics::kVirtualScan, [](auto scan) {
      std::fill(scan.ranges.begin(), scan.ranges.end(), scan.range_max);
      return scan;
    });
  if (module == "plan" && params.ignores_live_map) {
    alterations.heard<nav_msgs::OccupancyGrid>(topics::kLiveMap, emptied<nav_msgs::OccupancyGrid>);
    alterations.heard<docent_msgs::LiveMapUpdate>(topics::kLiveMapUpdate, emptied<docent_msgs::LiveMapUpdate>);
  }
  if (module == "executive" && params.takes_things_for_people)
    alterations.heard<docent_msgs::GoalState>(topics::kGoalState, [](auto state) {
      state.occupied = false;
      return state;
    });
  if (module == "head" && params.without_moods)
    alterations.said<docent_msgs::Expression>(topics::kExpression, [](auto expression) {
      expression.mood = to_text(Mood::neutral);
      expression.valence = 0.0;
      return expression;
    });
  if (module == "mission" && params.without_battery_watch) alterations.deaf_to(topics::kBattery);
  return alterations;
}

bool ignores_hazards(const AblationParams& params, std::string_view module) {
  return params.ignores_hazards && (module == "plan" || module == "explore");
}

museum::Museum without_hazards(museum::Museum museum) {
  museum.hazards.clear();
  museum.area.clear();
  return museum;
}

}  // namespace docent::apps::ablations
