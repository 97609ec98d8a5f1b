#include "docent/modules/drive/avoid_module.h"

#include <algorithm>
#include <utility>

#include "docent/collision_avoidance/avoider/avoider.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/messages/conversions.h"
#include "docent/messages/dock_topics.h"
#include "docent/modules/shared/museum_mode.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/stop_keeper.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {

namespace {

constexpr double kTick = 0.05;         // [s]
constexpr double kHeartbeat = 0.1;     // [s] between commands, whatever comes
constexpr double kLeastPause = 0.06;   // [s] from a choice to the next but one: faster lasers are only checked between
constexpr double kTogether = 0.02;     // [s] a choice waits so long for another laser's sweep
constexpr double kWindowPeriod = 0.5;  // [s] between two velocity spaces that are shown
constexpr Duration kModePeriod = std::chrono::seconds{1};

Result<collision_avoidance::BaseLimits> limits_of(const robot::RobotBody& body) {
  collision_avoidance::BaseLimits limits{body.radius,       body.max_speed,    body.max_turn_rate,
                                         body.acceleration, body.deceleration, body.turn_acceleration,
                                         body.latency,      body.watchdog,     {}};
  auto outline = collision_avoidance::Outline::of_body(body.outline);
  if (!outline) return tl::unexpected<Error>(outline.error());
  limits.outline = std::move(*outline);
  return limits;
}

/// With the stamp of its driver: `avoid` takes the clocks of all sensors into its own time.
collision_avoidance::SensorSweep to_sweep(const sensor_msgs::LaserScan& scan, const ScannerPlace& place,
                                          const std::vector<bool>& own_body) {
  return {from_message(scan.header.stamp),
          place.base_from_sensor,
          scan.angle_min,
          scan.angle_increment,
          scan.range_min,
          scan.range_max,
          scan.ranges,
          place.delay,
          own_body};
}

const char* name_of(collision_avoidance::AvoiderDecision::State state) {
  switch (state) {
    case collision_avoidance::AvoiderDecision::State::driving:
      return "driving";
    case collision_avoidance::AvoiderDecision::State::turning:
      return "turning";
    case collision_avoidance::AvoiderDecision::State::blocked:
      return "blocked";
    case collision_avoidance::AvoiderDecision::State::stopped:
      break;
  }
  return "stopped";
}

std::vector<std::string> laser_names(const robot::RobotBody& body) {
  std::vector<std::string> names;
  for (const robot::Scanner& scanner : body.scanners) names.push_back(scanner.name + " laser");
  return names;
}

class AvoidModule final : public Module {
 public:
  AvoidModule(const ModuleContext& context, const collision_avoidance::BaseLimits& limits,
              const collision_avoidance::AvoiderParams& params,
              std::unique_ptr<collision_avoidance::LocalPlanner> planner)
      : bus_{context.bus},
        mode_{context},
        body_{context.config.body()},
        cycle_{params.window.cycle},
        scanners_{nullptr, std::vector<double>(body_.scanners.size())},
        avoider_{limits, params, laser_names(body_), std::move(planner)},
        drive_{bus_.publisher(topics::kDrive)},
        state_{bus_.publisher(topics::kAvoidState)},
        stop_{context, "avoid", [this] { obey_stop(); }} {
    avoider_.know_map(std::make_shared<const OccupancyGrid>(context.museum.map));
    avoider_.stop_by_hand(stop_.holds());
    subscribe_sensors();
    subscribe_wishes();
    bus_.every(seconds(kTick), [this] { tick(); });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (auto complaint = avoider_.complaint_of_inputs(bus_.now())) return {"degraded", std::move(complaint->reason)};
    if (avoider_.is_carried_off()) return {"degraded", "carried off, as the scans say: not settled yet"};
    return stop_.health();
  }

 private:
  void subscribe_sensors() {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const nav_msgs::Odometry& odometry) {
      const collision_avoidance::BaseState state{from_message(odometry.pose.pose),
                                                 {odometry.twist.twist.linear.x, odometry.twist.twist.angular.z}};
      avoider_.add_odometry(bus_.now(), from_message(odometry.header.stamp), state);
    });
    scanners_.readers = subscribe_scanners(
        bus_, body_, [this](std::size_t i, const auto& scan, const auto& place) { see(i, scan, place); });
    bus_.subscribe<sensor_msgs::Range>(topics::kSonar, [this](const sensor_msgs::Range& range) {
      const auto index = body_.sonar_of(range.header.frame_id);
      if (!index) return;
      avoider_.add_sonar(bus_.now(), static_cast<std::size_t>(*index),
                         {from_message(range.header.stamp), body_.base_from_sonar(*index), range.field_of_view,
                          range.max_range, range.range});
    });
    bus_.subscribe<sensor_msgs::Range>(topics::kInfrared, [this](const sensor_msgs::Range& range) {
      const auto index = body_.infrared_of(range.header.frame_id);
      if (!index) return;
      avoider_.add_infrared(bus_.now(), static_cast<std::size_t>(*index),
                            {from_message(range.header.stamp), body_.base_from_infrared(*index), range.field_of_view,
                             range.max_range, range.range});
    });
    bus_.subscribe<docent_msgs::ObstacleLines>(topics::kObstacleLines, [this](const docent_msgs::ObstacleLines& seen) {
      std::vector<Segment> lines;
      for (const auto& line : seen.lines) lines.push_back({{line.x1, line.y1}, {line.x2, line.y2}});
      avoider_.add_lines(bus_.now(), from_message(seen.header.stamp), seen.source, seen.lifetime_s, lines);
      reflex();
    });
    bus_.subscribe<docent_msgs::Tactile>(topics::kTactile, [this](const docent_msgs::Tactile& tactile) {
      avoider_.add_tactile(bus_.now(), from_message(tactile.header.stamp), tactile.segments, tactile.scan);
      reflex();
    });
    bus_.subscribe<docent_msgs::Belief>(
        topics::kBelief, [this](const docent_msgs::Belief& belief) { on_belief(belief); },
        [this] { avoider_.add_belief({}); });  // it knows nothing
    bus_.subscribe<sensor_msgs::LaserScan>(topics::kVirtualScan, [this](const sensor_msgs::LaserScan& scan) {
      avoider_.add_virtual(bus_.now(), {from_message(scan.header.stamp), scan.angle_min, scan.angle_increment,
                                        scan.range_max, scan.ranges});
      reflex();
    });
    bus_.subscribe<docent_msgs::PersonBeams>(topics::kPersonBeams, [this](const docent_msgs::PersonBeams& beams) {
      std::vector<Point2> points;
      for (std::size_t i = 0; i < std::min(beams.x.size(), beams.y.size()); ++i)
        points.push_back({beams.x[i], beams.y[i]});
      avoider_.add_person_beams(bus_.now(), from_message(beams.header.stamp), points, beams.localized);
    });
  }

  void obey_stop() {
    avoider_.stop_by_hand(stop_.holds());
    decide();
  }

  void limit_speed() {
    if (const auto speed = mode_.max_speed(bus_.now())) avoider_.set_max_speed(*speed);
  }

  void subscribe_wishes() {
    bus_.subscribe<docent_msgs::Limits>(topics::kLimits, [this](const docent_msgs::Limits& limits) {
      mode_.limits(limits);
      limit_speed();
    });
    bus_.subscribe<docent_msgs::Calibration>(topics::kCalibration, [this](const auto& calibration) {
      mode_.calibration(calibration);
      limit_speed();
    });
    bus_.every(kModePeriod, [this] { limit_speed(); });
    bus_.subscribe<docent_msgs::Steering>(topics::kSteering, [this](const docent_msgs::Steering& steering) {
      avoider_.steer_by_hand(bus_.now(), {steering.is_pressed, steering.forward, steering.turn});
      reflex();  // a hand that lets go
    });
    bus_.subscribe<docent_msgs::Drive>(topics::kDockDrive, [this](const docent_msgs::Drive& wish) {
      avoider_.dock_with(bus_.now(), {wish.linear, wish.angular});
      reflex();
    });
    bus_.subscribe<docent_msgs::Target>(topics::kTarget, [this](const docent_msgs::Target& target) {
      collision_avoidance::AvoiderTarget wish;
      const auto mode = parse<DriveMode>(target.mode);
      wish.mode = mode == DriveMode::drive  ? collision_avoidance::AvoiderTarget::Mode::drive
                  : mode == DriveMode::turn ? collision_avoidance::AvoiderTarget::Mode::turn
                                            : collision_avoidance::AvoiderTarget::Mode::stop;
      for (std::size_t i = 0; i < std::min(target.via_x.size(), target.via_y.size()); ++i) {
        wish.via.push_back({target.via_x[i], target.via_y[i]});
      }
      wish.is_final = target.is_final;
      wish.heading = Angle::radians(target.heading);
      wish.position_tolerance = target.position_tolerance;
      wish.heading_tolerance = target.heading_tolerance;
      const bool is_other = std::exchange(target_mode_, wish.mode) != wish.mode;
      avoider_.set_target(bus_.now(), from_message(target.header.stamp), std::move(wish));
      if (is_other) decide();  // above all: a stop
    });
  }

  void on_belief(const docent_msgs::Belief& belief) {
    believed_.cells.clear();
    for (const auto& cell : belief.cells)
      believed_.cells.push_back({{cell.x, cell.y, Angle::radians(cell.theta)}, static_cast<double>(cell.mass)});
    believed_.hypotheses.clear();
    for (const auto& mode : belief.hypotheses)
      believed_.hypotheses.push_back({{mode.x, mode.y, Angle::radians(mode.theta)}, mode.mass});
    const auto& modes = believed_.hypotheses;
    avoider_.add_belief({believed_.cells, modes, belief.p_lost, belief.localized});
    if (!modes.empty())
      avoider_.add_place(bus_.now(), from_message(belief.header.stamp), modes.front().map_from_robot,
                         from_message(belief.odom_pose), modes.front().mass);
  }

  void see(std::size_t sensor, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    // A scan of a part of the field would leave the rest as if nothing were there.
    constexpr double kFieldShare = 0.9;
    const double field = static_cast<double>(scan.angle_increment) * static_cast<double>(scan.ranges.size());
    scanners_.widest_field[sensor] = std::max(scanners_.widest_field[sensor], field);
    if (field < kFieldShare * scanners_.widest_field[sensor]) return;
    const Time now = bus_.now();
    avoider_.add_sweep(now, sensor, to_sweep(scan, place, scanners_.readers->own_body(sensor)));
    if (now - decided_before_ < seconds(kLeastPause)) return reflex();
    if (!avoider_.awaits_sweep(now, kTogether)) return decide();
    reflex();
    bus_.after(seconds(kTogether), [this, now] {
      if (decided_ < now) decide();  // it has not come
    });
  }

  void decide() {
    decided_before_ = std::exchange(decided_, bus_.now());
    const collision_avoidance::AvoiderDecision choice = avoider_.decide(decided_);
    const auto check = avoider_.reflex(decided_);
    publish(check ? *check : choice);
  }

  void reflex() {
    if (auto decision = avoider_.reflex(bus_.now())) publish(*decision);
  }

  void tick() {
    const Time now = bus_.now();
    if (now - decided_ >= seconds(cycle_ - 0.5 * kTick)) {
      decide();  // the lasers are slow, or silent
    } else if (now - driven_ >= seconds(kHeartbeat - 0.5 * kTick)) {
      if (auto decision = avoider_.reflex(now)) return publish(*decision);  // something may have fallen silent
      publish_drive(avoider_.command());
    }
  }

  void publish_drive(const collision_avoidance::Velocity& command) {
    driven_ = bus_.now();
    drive_.publish({{to_message(driven_), "base_link"}, command.linear, command.angular});
  }

  void publish(const collision_avoidance::AvoiderDecision& decision) {
    publish_drive(decision.command);
    docent_msgs::AvoidState state;
    state.header = {to_message(driven_), "base_link"};
    state.state = name_of(decision.state);
    state.reason = decision.reason;
    state.speed_cap = decision.speed_cap;
    state.linear = decision.command.linear;
    state.angular = decision.command.angular;
    state.path_blocked = decision.path_blocked;
    state.unmapped_obstacle = decision.unmapped_obstacle;
    state.low_obstacle = decision.low_obstacle;
    state.carried_off = avoider_.times_carried_off();
    state.nearest_real_m = decision.nearest_real;
    state.nearest_virtual_m = decision.nearest_virtual;
    if (!decision.window.empty() && driven_ - window_shown_ >= seconds(kWindowPeriod - 0.5 * kTick)) {
      window_shown_ = driven_;
      for (const auto& candidate : decision.window) {
        state.window.push_back({static_cast<float>(candidate.velocity.linear),
                                static_cast<float>(candidate.velocity.angular), static_cast<float>(candidate.value)});
      }
    }
    state_.publish(std::move(state));
  }

  transport::Bus& bus_;
  MuseumMode mode_;
  robot::RobotBody body_;
  double cycle_;
  struct {
    std::shared_ptr<const ScannerReaders> readers;
    std::vector<double> widest_field;  ///< [scanners] [rad] that each has shown
  } scanners_;
  collision_avoidance::Avoider avoider_;
  struct {
    std::vector<collision_avoidance::BelievedPose> cells, hypotheses;
  } believed_;  ///< of the newest belief
  transport::Publisher<docent_msgs::Drive> drive_;
  transport::Publisher<docent_msgs::AvoidState> state_;
  collision_avoidance::AvoiderTarget::Mode target_mode_ = collision_avoidance::AvoiderTarget::Mode::stop;
  Time decided_{};         ///< the last choice
  Time decided_before_{};  ///< the choice before that
  Time driven_{};          ///< the last command
  Time window_shown_{};
  StopKeeper stop_;  ///< last: it calls
};

}  // namespace

Result<std::unique_ptr<Module>> make_avoid(const ModuleContext& context) { return make_avoid_with(context, {}); }

Result<std::unique_ptr<Module>> make_avoid_with(const ModuleContext& context,
                                                const collision_avoidance::LocalPlannerMaker& make_planner) {
  auto params = context.config.section<collision_avoidance::AvoiderParams>("avoid");
  if (!params) return tl::unexpected<Error>(params.error());
  const robot::RobotBody& body = context.config.body();
  // Where no laser looks, silent sonars are no sight at all, whatever the configuration says.
  params->needs_sonar = body.sonars > 0 && (params->needs_sonar || body.scanners.empty());
  params->has_infrared = body.infrareds > 0;
  params->has_tactile = body.tactile;
  params->has_lasers = !body.scanners.empty();
  const auto lowest = std::min_element(body.scanners.begin(), body.scanners.end(),
                                       [](const auto& a, const auto& b) { return a.height < b.height; });
  if (lowest != body.scanners.end()) params->laser_height = lowest->height;
  auto limits = limits_of(body);
  if (!limits) return tl::unexpected<Error>(limits.error());
  return std::make_unique<AvoidModule>(context, *limits, *params, make_planner ? make_planner(*limits) : nullptr);
}

Result<robot::ParameterRows> parameters_of_avoid(const robot::RobotConfig& config) {
  return robot::list_parameters<collision_avoidance::AvoiderParams>(config, "avoid");
}

}  // namespace docent::modules
