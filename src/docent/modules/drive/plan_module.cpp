#include "docent/modules/drive/plan_module.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "docent/mapping/occupancy/live_map.h"
#include "docent/modules/shared/grid_message.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/scanners.h"
#include "docent/planning/coastal/coastal_planner.h"
#include "docent/planning/exploration/clearances.h"
#include "docent/planning/exploration/look_around.h"
#include "docent/planning/exploration/tell_apart.h"
#include "docent/planning/pursuit/pursuit.h"
#include "docent/planning/value_iteration/route.h"
#include "docent/planning/value_iteration/value_picture.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds{200};
constexpr Duration kValuePeriod = std::chrono::seconds{2};
constexpr int kValueCoarsening = 2;
constexpr int kVisitsAStep = 200;     ///< any-time: so many tiles of the value function between two targets
constexpr int kCoastSweepsAStep = 2;  ///< of the coastal planner, which has more to do in one
constexpr int kCoastCoarsening = 2;   ///< its cell = so many planning cells
constexpr double kOffCoast = 2.0;     ///< [m] beside its way, from where it looks for another
constexpr int kStepsAPath = 5;        ///< the page sees the path at 1 Hz
constexpr double kLookAhead = 1.5;    ///< [m] along the way: where the head looks
constexpr Duration kBeliefStaleAfter = std::chrono::seconds{3};

/// Section `plan`: ways through the building.
struct PlanParams {
  planning::RouteParams route;
  planning::PursuitParams pursuit;
  planning::TellApartParams tell_apart;
  planning::CoastalParams coastal;
  bool active = true;           ///< lost: drives to where its hypotheses are told apart; else it only looks round
  double goal_tolerance = 0.2;  ///< [m] >= 0: cells so near to the goal are goals
  template <class V>
  void visit(V& v) {
    v("route", route);
    v("pursuit", pursuit);
    v("tell_apart", tell_apart);
    v("coastal", coastal);
    v("active", active);
    v("goal_tolerance", goal_tolerance);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(goal_tolerance >= 0.0)) return fail("goal_tolerance must be >= 0");
    if (auto valid = route.validate(); !valid) return valid;
    if (auto valid = tell_apart.validate(); !valid) return valid;
    if (auto valid = coastal.validate(); !valid) return fail("coastal." + valid.error().message);
    return pursuit.validate();
  }
};

class PlanModule final : public Module {
 public:
  PlanModule(const ModuleContext& context, const PlanParams& params)
      : bus_{context.bus},
        params_{params},
        route_{context.museum.map, context.museum.hazard_polygons(), context.museum.area, params.route},
        pursuit_{params.pursuit},
        tell_apart_{context.museum.map, context.config.body().radius, params.tell_apart},
        base_from_laser_{mounts_of(context.config.body().scanners)},
        scans_(base_from_laser_.size()),
        target_{bus_.publisher(topics::kTarget)},
        goal_state_{bus_.publisher(topics::kGoalState)},
        value_{bus_.publisher(topics::kValueFunction)},
        path_{bus_.publisher(topics::kPath)},
        gaze_{bus_.publisher(topics::kGaze)} {
    const OccupancyGrid coarse = coarsened(context.museum.map, params.route.coarsening);
    static_cells_ = coarse.cells;
    obstacles_.assign(route_.frame().size(), false);
    settled_.assign(route_.frame().size(), false);
    if (params.coastal.weight > 0.0)
      coastal_.emplace(context.museum.map,
                       planning::CoastalFloor::of(route_.frame(), route_.static_costs(), kCoastCoarsening),
                       params.coastal);

    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) {
      pose_.on_belief(belief);
      hypotheses_ = belief.hypotheses;
      odom_at_belief_ = from_message(belief.odom_pose);
    });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry,
                                       [this](const auto& odometry) { pose_.on_odometry(odometry); });
    subscribe_scanners(bus_, context.config.body(), [this](std::size_t i, const auto& scan) { scans_[i] = scan; });
    bus_.subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [this](const auto& scan) { virtual_scan_ = scan; });
    bus_.subscribe<nav_msgs::OccupancyGrid>(topics::kLiveMap, [this](const auto& map) { on_full_map(map); });
    bus_.subscribe<docent_msgs::LiveMapUpdate>(topics::kLiveMapUpdate,
                                               [this](const auto& update) { on_update(update); });
    bus_.subscribe<docent_msgs::DriveGoal>(topics::kDriveGoal, [this](const auto& goal) { on_goal(goal); });
    publish_state(planning::Pursuit{});
    subscribe_operator();
    bus_.every(kPeriod, [this] { step(); });
    bus_.every(kValuePeriod, [this] { publish_value(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!pose_.odom_from_base()) return {"degraded", "no odometry"};
    if (!pose_.map_from_base()) return {"degraded", "no belief"};
    return {};
  }

 private:
  void subscribe_operator() {
    bus_.subscribe<docent_msgs::Stop>(topics::kStop, [this](const auto& stop) { is_stopped_ = stop.is_stopped; });
    bus_.subscribe<docent_msgs::Steering>(topics::kSteering, [this](const auto&) { steered_ = bus_.now(); });
  }

  void on_goal(const docent_msgs::DriveGoal& goal) {
    const bool is_new = goal.id != goal_.id;
    goal_ = goal;
    pursuit_.set_goal(
        {goal.id, {goal.x, goal.y, Angle::radians(goal.theta)}, goal.position_tolerance, goal.heading_tolerance},
        bus_.now());
    if (!is_new) return;
    if (goal.relocalize) look_around_.start(bus_.now());
    if (!goal.id.empty() && !goal.relocalize) {
      route_.set_obstacles(obstacles_, settled_);
      seek_coast({goal.x, goal.y});
      route_.set_goal({goal.x, goal.y}, goal_tolerance());
    }
    step();
  }

  void on_full_map(const nav_msgs::OccupancyGrid& map) {
    if (map.data.size() != obstacles_.size()) return;  // another map: this one knows only its own
    base_ = from_message(map.header.stamp);
    number_ = 0;
    for (std::size_t i = 0; i < map.data.size(); ++i) take(i, map.data[i]);
    note_change({0, 0}, {route_.frame().columns - 1, route_.frame().rows - 1});
  }
  void on_update(const docent_msgs::LiveMapUpdate& update) {
    if (from_message(update.base) != base_ || update.number != number_ + 1) return;  // a gap: wait for the full map
    if (update.data.size() != static_cast<std::size_t>(update.width) * update.height) return;
    number_ = update.number;
    if (update.data.empty()) return;
    std::size_t k = 0;
    for (std::uint32_t row = 0; row < update.height; ++row) {
      for (std::uint32_t column = 0; column < update.width; ++column, ++k) {
        const CellIndex cell{update.x + static_cast<int>(column), update.y + static_cast<int>(row)};
        if (!route_.frame().holds(cell)) continue;
        take(route_.frame().index(cell), update.data[k]);
      }
    }
    note_change({update.x, update.y},
                {update.x + static_cast<int>(update.width) - 1, update.y + static_cast<int>(update.height) - 1});
  }
  /// Between the last setting of obstacles and the next.
  void note_change(CellIndex low, CellIndex high) {
    low = {std::max(low.column, 0), std::max(low.row, 0)};
    high = {std::min(high.column, route_.frame().columns - 1), std::min(high.row, route_.frame().rows - 1)};
    if (changed_) {
      low = {std::min(low.column, changed_->low.column), std::min(low.row, changed_->low.row)};
      high = {std::max(high.column, changed_->high.column), std::max(high.row, changed_->high.row)};
    }
    changed_ = planning::CellBox{low, high};
  }
  void take(std::size_t index, std::int8_t live) {
    obstacles_[index] = live >= 65 && static_cells_[index] < 65;
    settled_[index] = obstacles_[index] && live >= mapping::LiveMap::kSettled;
  }

  void step() {
    const Time now = bus_.now();
    if (goal_.relocalize && !goal_.id.empty()) return step_relocalize(now);
    if (changed_ && !goal_.id.empty()) {
      route_.set_obstacles(obstacles_, settled_, changed_);
      changed_.reset();
    }
    if (!goal_.id.empty()) follow_coast();
    plan_ahead();
    const bool knows = pose_.localized() && now - pose_.belief_stamp() < kBeliefStaleAfter;
    constexpr Duration kAfterSteering = std::chrono::seconds{3};  // until the avoidance goes its own way again
    if (is_stopped_ || (steered_ && now - *steered_ < kAfterSteering)) pursuit_.hold(now);
    const planning::Pursuit pursuit = pursuit_.step(knows ? pose_.map_from_base() : std::nullopt, route_, now);
    publish_target(pursuit, now);
    publish_state(pursuit);
    if (step_count_++ % kStepsAPath == 0) publish_path(pursuit, now);
  }

  /// [m]: a way must end where the robot counts as arrived, whatever the goal asks for; a cell is 0.05 m wide.
  [[nodiscard]] double goal_tolerance() const {
    return std::min(params_.goal_tolerance, std::max(0.0, goal_.position_tolerance - 0.05));
  }

  /// The coastal planner begins; until it has a way the robot takes the shortest.
  void seek_coast(Point2 goal) {
    if (!coastal_) return;
    coast_.clear();
    route_.prefer({});
    coastal_->set_goal(goal, goal_tolerance());
  }

  /// Any-time, like the route: when the values have settled, or the robot has been driven off, the way is taken anew.
  void follow_coast() {
    if (!coastal_ || hypotheses_.empty()) return;
    const bool was_settled = coastal_->is_settled();
    const auto here = pose_.map_from_base();
    if (!coastal_->iterate(kCoastSweepsAStep) || !here) return;
    const bool is_off = std::none_of(coast_.begin(), coast_.end(),
                                     [&](Point2 point) { return distance(point, here->position()) < kOffCoast; });
    if (was_settled && !(is_off && !coast_.empty())) return;
    coast_ = coastal_->way(here->position(), coastal_->uncertainty().variance_of(hypotheses_.front().covariance));
    route_.prefer(coast_);
  }

  void plan_ahead() {
    if (goal_.id.empty()) return;
    const auto here = pose_.map_from_base();
    if (!here) {
      route_.iterate(kVisitsAStep);
      return;
    }
    route_.settle(here->position(), kVisitsAStep);
    route_.hold_way(here->position());
  }

  void step_relocalize(Time now) {
    docent_msgs::Target target;
    target.header = {to_message(now), "odom"};
    target.goal_id = goal_.id;
    target.mode = to_text(DriveMode::stop);
    planning::Pursuit pursuit;
    pursuit.state = pose_.localized() ? GoalStatus::arrived : GoalStatus::waiting;
    pursuit.reason = pose_.localized() ? "" : "looking around to find the position";
    if (!pose_.localized() && pose_.odom_from_base()) {
      const auto step = look_around(now);
      target.mode = to_text(step.drive ? DriveMode::drive : DriveMode::turn);
      target.heading = step.heading.radians();
      if (step.drive) {
        target.via_x = {step.via.x};
        target.via_y = {step.via.y};
        target.is_final = true;
      }
      pursuit.blocked_s = look_around_.held_up_s(now);
    }
    target_.publish(std::move(target));
    publish_state(pursuit);
  }

  planning::LookAroundStep look_around(Time now) {
    const auto free = clearances(now);
    const auto telling = [&]() -> std::optional<Point2> {
      if (!params_.active || !pose_.map_from_odom()) return std::nullopt;
      // The hypotheses are those of the last update: odometry carries them on.
      const Pose2 moved = inverse(odom_at_belief_) * *pose_.odom_from_base();
      std::vector<planning::PossiblePose> possible;
      for (const auto& h : hypotheses_) possible.push_back({Pose2{h.x, h.y, Angle::radians(h.theta)} * moved, h.mass});
      std::optional<Point2> last;
      if (telling_goal_) last = inverse(*pose_.odom_from_base()) * *telling_goal_;
      const auto place = tell_apart_.best_place(possible, free, reach_of_scanners(), last);
      telling_goal_.reset();
      if (!place) return std::nullopt;
      telling_goal_ = *pose_.odom_from_base() * place->goal;
      return place->in_base;
    };
    return look_around_.step(*pose_.odom_from_base(), free, telling, now);
  }

  /// The smaller of real and virtual measurements in every direction from where the base is now; where no scanner reads
  /// now, what one saw there a moment ago. Empty when any is missing or old.
  [[nodiscard]] std::vector<double> clearances(Time now) {
    constexpr Duration kStale = std::chrono::seconds{2};
    constexpr Duration kLooked =
        std::chrono::milliseconds{5500};  // about a full turn; odometry's poses are kept for 6 s
    constexpr Duration kBetweenLooks = std::chrono::milliseconds{300};
    const auto look = [&](planning::Clearances& clearances, const sensor_msgs::LaserScan& scan,
                          const Pose2& then_from_sensor, Duration stale) {
      const Time stamp = from_message(scan.header.stamp);
      const auto odom_from_then = pose_.odom_from_base_at(stamp);
      if (scan.ranges.empty() || now - stamp > stale || !odom_from_then) return false;
      const Pose2 base_from_then = inverse(*pose_.odom_from_base()) * *odom_from_then;
      clearances.add(base_from_then * then_from_sensor, scan.angle_min, scan.angle_increment, scan.range_max,
                     scan.ranges);
      return true;
    };
    planning::Clearances real;
    planning::Clearances virtual_ones;
    bool complete = !scans_.empty() && look(virtual_ones, virtual_scan_, Pose2{}, kStale);
    for (std::size_t i = 0; i < scans_.size() && complete; ++i)
      complete = look(real, scans_[i], base_from_laser_[i], kStale);
    if (!complete) return {};
    for (auto past = past_looks_.rbegin(); past != past_looks_.rend(); ++past) {
      planning::Clearances then;
      for (std::size_t i = 0; i < past->scans.size(); ++i)
        (void)look(then, past->scans[i], base_from_laser_[i], kLooked);
      real.fill(then);
    }
    while (!past_looks_.empty() && now - past_looks_.front().at > kLooked) past_looks_.pop_front();
    if (past_looks_.empty() || now - past_looks_.back().at >= kBetweenLooks) past_looks_.push_back({now, scans_});
    std::vector<double> result = real.free();
    const auto of_hazards = virtual_ones.free();
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::min(result[i], of_hazards[i]);
    return result;
  }

  /// [m] that the scanners look.
  [[nodiscard]] double reach_of_scanners() const {
    float reach = 0.0F;
    for (const auto& scan : scans_) reach = std::max(reach, scan.range_max);
    return static_cast<double>(reach);
  }

  /// Of the way that it plans now; nothing where it plans none.
  void publish_value() {
    const bool has_goal = !goal_.id.empty();
    if (!has_goal && !had_value_) return;
    had_value_ = has_goal;
    planning::ValuePicture picture = planning::value_picture(route_.values(), kValueCoarsening);
    const Time now = bus_.now();
    nav_msgs::OccupancyGrid message{{to_message(now), "map"}, info_of(picture.frame, now), std::move(picture.shares)};
    if (!has_goal) message.info.width = message.info.height = 0, message.data.clear();
    value_.publish(std::move(message));
  }

  void publish_target(const planning::Pursuit& pursuit, Time now) {
    docent_msgs::Target target;
    target.header = {to_message(now), "odom"};
    target.goal_id = goal_.id;
    target.mode = to_text(pursuit.mode);
    target.is_final = pursuit.is_final;
    target.position_tolerance = goal_.position_tolerance;
    target.heading_tolerance = goal_.heading_tolerance;
    if (pursuit.mode != DriveMode::stop) {
      const Pose2 odom_from_map = inverse(pose_.map_from_odom().value_or(Pose2{}));
      target.heading = (odom_from_map.theta + pursuit.heading).radians();
      for (const Point2& via : pursuit.via) {
        const Point2 in_odom = odom_from_map * via;
        target.via_x.push_back(in_odom.x);
        target.via_y.push_back(in_odom.y);
      }
    }
    publish_gaze(pursuit.mode, target, now);
    target_.publish(std::move(target));
  }

  /// The head looks where the robot wants to go, above all while it cannot.
  void publish_gaze(DriveMode mode, const docent_msgs::Target& target, Time now) {
    if (!pose_.odom_from_base()) return;
    docent_msgs::Gaze gaze;
    gaze.header = {to_message(now), "odom"};
    const GazeAt at = mode == DriveMode::drive ? GazeAt::way : mode == DriveMode::turn ? GazeAt::goal : GazeAt::none;
    gaze.at = to_text(at);
    const Pose2 odom_from_base = *pose_.odom_from_base();
    gaze.heading = at == GazeAt::none ? odom_from_base.theta.radians() : target.heading;
    for (std::size_t i = 0; at == GazeAt::way && i < target.via_x.size(); ++i) {
      const Point2 via{target.via_x[i], target.via_y[i]};
      gaze.heading = direction(odom_from_base.position(), via).radians();
      if (distance(odom_from_base.position(), via) > kLookAhead) break;
    }
    gaze.bearing = (Angle::radians(gaze.heading) - odom_from_base.theta).radians();
    gaze_.publish(std::move(gaze));
  }

  void publish_state(const planning::Pursuit& pursuit) {
    docent_msgs::GoalState state;
    state.id = goal_.id;
    state.state = to_text(pursuit.state);
    state.remaining_m = pursuit.remaining_m;
    state.blocked_s = pursuit.blocked_s;
    state.reason = pursuit.reason;
    state.detour = planning::to_text(pursuit.detour);
    state.detour_extra = pursuit.detour_extra;
    state.header = {to_message(bus_.now()), "map"};
    goal_state_.publish(std::move(state));
  }

  void publish_path(const planning::Pursuit& pursuit, Time now) {
    nav_msgs::Path path;
    path.header = {to_message(now), "map"};
    const auto here = pose_.map_from_base();
    if (pursuit.mode == DriveMode::drive && here) {
      for (const Point2& point : route_.way(here->position())) {
        path.poses.push_back({path.header, to_message(Pose2{point.x, point.y, {}})});
      }
    }
    if (path.poses.empty() && path_was_empty_) return;
    path_was_empty_ = path.poses.empty();
    path_.publish(std::move(path));
  }

  transport::Bus& bus_;
  PlanParams params_;
  planning::RoutePlanner route_;
  std::optional<planning::CoastalPlanner> coastal_;  ///< with `coastal.weight` alone
  std::vector<Point2> coast_;                        ///< [m], map: its way; empty: none yet
  bool is_stopped_ = false;                          ///< by an operator
  std::optional<Time> steered_;                      ///< by an operator, last
  planning::GoalPursuit pursuit_;
  planning::LookAround look_around_;
  planning::TellApart tell_apart_;
  std::optional<Point2> telling_goal_;  ///< odom: where it drives to tell its hypotheses apart
  std::vector<Pose2> base_from_laser_;  ///< [scanners]
  struct PastLook {
    Time at;
    std::vector<sensor_msgs::LaserScan> scans;  ///< [scanners]
  };
  std::deque<PastLook> past_looks_;            ///< while it looks round
  std::vector<sensor_msgs::LaserScan> scans_;  ///< [scanners] newest sweeps
  transport::Publisher<docent_msgs::Target> target_;
  transport::Publisher<docent_msgs::GoalState> goal_state_;
  transport::Publisher<nav_msgs::OccupancyGrid> value_;
  transport::Publisher<nav_msgs::Path> path_;
  transport::Publisher<docent_msgs::Gaze> gaze_;
  PoseTracker pose_;
  std::vector<docent_msgs::Hypothesis> hypotheses_;  ///< of the last belief
  Pose2 odom_at_belief_;
  docent_msgs::DriveGoal goal_;
  sensor_msgs::LaserScan virtual_scan_;
  std::vector<std::int8_t> static_cells_;  ///< [rows * columns of the planning grid]
  std::vector<bool> obstacles_;            ///< [rows * columns] what stands there now
  std::vector<bool> settled_;              ///< those of them that have stood there for long
  Time base_{};
  std::uint32_t number_ = 0;
  std::optional<planning::CellBox> changed_;  ///< where `obstacles_` may differ from those of `route_`
  bool path_was_empty_ = true;
  bool had_value_ = false;
  int step_count_ = 0;
};

}  // namespace

Result<std::unique_ptr<Module>> make_plan(const ModuleContext& context) {
  auto params = context.config.section<PlanParams>("plan");
  if (!params) return tl::unexpected<Error>(params.error());
  params->route.robot_radius = context.config.body().radius;
  return std::make_unique<PlanModule>(context, *params);
}

Result<museum::CheckedRobot> checked_robot_of_plan(const robot::RobotConfig& config) {
  const auto params = config.section<PlanParams>("plan");
  if (!params) return tl::unexpected<Error>(params.error());
  return museum::CheckedRobot{config.body().radius, params->route.clearance, params->route.coarsening};
}

Result<robot::ParameterRows> parameters_of_plan(const robot::RobotConfig& config) {
  return robot::list_parameters<PlanParams>(config, "plan");
}

}  // namespace docent::modules
