#include "docent/modules/drive/plan_module.h"

#include "docent/messages/fit_target.h"
#include "docent/modules/shared/grid_message.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/sensor_time.h"
#include "docent/modules/shared/stop_keeper.h"
#include "docent/planning/navigator/navigator.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

using planning::Navigator;

constexpr Duration kValuePeriod = std::chrono::seconds{2};

planning::PoseBelief belief_of(const docent_msgs::Belief& message) {
  planning::PoseBelief belief;
  for (const auto& h : message.hypotheses)
    belief.hypotheses.push_back({Pose2{h.x, h.y, Angle::radians(h.theta)}, h.covariance, h.mass});
  belief.odom_from_base = from_message(message.odom_pose);
  return belief;
}

planning::Sweep sweep_of(const sensor_msgs::LaserScan& scan, Time taken) {
  return {taken, scan.angle_min, scan.angle_increment, scan.range_max, scan.ranges};
}

planning::LivePatch patch_of(const docent_msgs::LiveMapUpdate& update) {
  return {from_message(update.base), update.number, {update.x, update.y}, update.width, update.height, update.data};
}

planning::PursuitGoal goal_of(const docent_msgs::DriveGoal& goal) {
  return {goal.id, {goal.x, goal.y, Angle::radians(goal.theta)}, goal.position_tolerance, goal.heading_tolerance};
}

docent_msgs::Target message_of(const planning::Aim& aim, const std::string& goal_id, Time now) {
  docent_msgs::Target target;
  target.header = {to_message(now), "odom"};
  target.goal_id = goal_id;
  target.mode = to_text(aim.mode);
  target.is_final = aim.is_final;
  target.position_tolerance = aim.position_tolerance;
  target.heading_tolerance = aim.heading_tolerance;
  target.heading = aim.heading.radians();
  for (const Point2& via : aim.via) {
    target.via_x.push_back(via.x);
    target.via_y.push_back(via.y);
  }
  return fit_target(std::move(target));
}

docent_msgs::Gaze message_of(const planning::Look& look, Time now) {
  return {{to_message(now), "odom"}, to_text(look.at), look.heading.radians(), look.bearing.radians()};
}

docent_msgs::GoalState message_of(const planning::Pursuit& report, const std::string& goal_id, Time now) {
  return {{to_message(now), "map"}, goal_id,           to_text(report.state), report.remaining_m,
          report.straight_m,        report.blocked_s,  report.reason,         planning::to_text(report.detour),
          report.detour_extra,      report.is_occupied};
}

nav_msgs::Path message_of(const std::vector<Point2>& way, Time now) {
  nav_msgs::Path path;
  path.header = {to_message(now), "map"};
  for (const Point2& point : way) path.poses.push_back({path.header, to_message(Pose2{point.x, point.y, {}})});
  return path;
}

class PlanModule final : public Module {
 public:
  PlanModule(transport::Bus& bus, const robot::RobotBody& body, Navigator navigator)
      : bus_{bus},
        pose_{reach_of(body)},
        navigator_{std::move(navigator)},
        target_{bus_.publisher(topics::kTarget)},
        goal_state_{bus_.publisher(topics::kGoalState)},
        value_{bus_.publisher(topics::kValueFunction)},
        path_{bus_.publisher(topics::kPath)},
        gaze_{bus_.publisher(topics::kGaze)} {
    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) {
      pose_.on_belief(belief);
      navigator_.believe(belief_of(belief));
    });
    bus_.subscribe<nav_msgs::Odometry>(
        topics::kOdometry, [this](const auto& odometry) { pose_.on_odometry(odometry, sensor_time_.of(odometry)); });
    subscribe_scanners(bus_, body, [this](std::size_t i, const auto& scan, const auto& place) {
      navigator_.lookout().mount(i, place.base_from_sensor);
      navigator_.lookout().see(i, sweep_of(scan, sensor_time_.of(i, scan, place)));
    });
    bus_.subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [this](const auto& scan) {
      navigator_.lookout().see_hazards(sweep_of(scan, from_message(scan.header.stamp)));
    });
    bus_.subscribe<nav_msgs::OccupancyGrid>(topics::kLiveMap, [this](const auto& map) {
      navigator_.live_obstacles().take_map(from_message(map.header.stamp), map.data);
    });
    bus_.subscribe<docent_msgs::LiveMapUpdate>(topics::kLiveMapUpdate, [this](const auto& update) {
      navigator_.live_obstacles().take_patch(patch_of(update));
    });
    bus_.subscribe<docent_msgs::DriveGoal>(topics::kDriveGoal, [this](const auto& goal) {
      const auto orders = navigator_.set_goal(goal_of(goal), goal.relocalize, whereabouts(), bus_.now());
      if (orders) publish(*orders);
    });
    goal_state_.publish(message_of(planning::Pursuit{}, "", bus_.now()));
    bus_.subscribe<docent_msgs::Stop>(
        topics::kStop, [this, view = StopView{}](const auto& stop) mutable { navigator_.stop(view.see(stop)); });
    bus_.subscribe<docent_msgs::Steering>(topics::kSteering, [this](const auto&) { navigator_.steer(bus_.now()); });
    bus_.every(Navigator::kStepPeriod, [this] { publish(navigator_.step(whereabouts(), bus_.now())); });
    bus_.every(kValuePeriod, [this] { publish_values(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!pose_.odom_from_base()) return {"degraded", "no odometry"};
    if (!pose_.map_from_base()) return {"degraded", "no belief"};
    if (std::string why = navigator_.hindrance(); !why.empty()) return {"degraded", std::move(why)};
    return {};
  }

 private:
  [[nodiscard]] planning::Whereabouts whereabouts() const {
    return {pose_.localized(), pose_.belief_stamp(), pose_.map_from_odom(), pose_.odom_from_base(),
            [this](Time time) { return pose_.odom_from_base_at(time); }};
  }

  void publish(const planning::Orders& orders) {
    const Time now = bus_.now();
    if (orders.look) gaze_.publish(message_of(*orders.look, now));
    target_.publish(message_of(orders.aim, orders.goal_id, now));
    goal_state_.publish(message_of(orders.report, orders.goal_id, now));
    if (orders.path) path_.publish(message_of(*orders.path, now));
  }

  void publish_values() {
    auto picture = navigator_.value_picture();
    if (!picture) return;
    const Time now = bus_.now();
    value_.publish({{to_message(now), "map"}, info_of(picture->frame, now), std::move(picture->shares)});
  }

  transport::Bus& bus_;
  SensorTime sensor_time_{bus_};
  PoseTracker pose_;
  Navigator navigator_;
  transport::Publisher<docent_msgs::Target> target_;
  transport::Publisher<docent_msgs::GoalState> goal_state_;
  transport::Publisher<nav_msgs::OccupancyGrid> value_;
  transport::Publisher<nav_msgs::Path> path_;
  transport::Publisher<docent_msgs::Gaze> gaze_;
};

}  // namespace

Result<std::unique_ptr<Module>> make_plan(const ModuleContext& context) {
  auto params = context.config.section<planning::NavigatorParams>("plan");
  if (!params) return tl::unexpected<Error>(params.error());
  const robot::RobotBody& body = context.config.body();
  params->route.robot_radius = body.radius;
  const planning::DrivableGround ground{context.museum.hazard_polygons(), context.museum.area};
  Navigator navigator{context.museum.map, ground, mounts_of(body.scanners), *params};
  return std::make_unique<PlanModule>(context.bus, body, std::move(navigator));
}

Result<museum::CheckedRobot> checked_robot_of_plan(const robot::RobotConfig& config) {
  const auto params = config.section<planning::NavigatorParams>("plan");
  if (!params) return tl::unexpected<Error>(params.error());
  return museum::CheckedRobot{config.body().radius, params->route.clearance, params->route.coarsening};
}

Result<robot::ParameterRows> parameters_of_plan(const robot::RobotConfig& config) {
  return robot::list_parameters<planning::NavigatorParams>(config, "plan");
}

}  // namespace docent::modules
