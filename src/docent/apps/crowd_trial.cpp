#include "docent/apps/crowd_trial.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "docent/messages/conversions.h"
#include "docent/modules/module_host.h"
#include "docent/pictures/drawing.h"
#include "docent/simulator/crowd/crowd.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/simulator/world/world_picture.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent {
namespace {

constexpr double kRobotRadius = 0.265;  // [m]

/// Stands for localization, hazards and plan: in this hall nothing is hidden from the sensors, and the way is straight.
/// It knows where the robot is; odometry alone would miss the goal by more than its radius, also in the empty hall.
class Courier {
 public:
  Courier(Bus& bus, Point2 goal, double tolerance, double max_speed)
      : bus_{bus},
        goal_in_hall_{goal},
        tolerance_{tolerance},
        targets_{bus.publisher(topics::kTarget)},
        virtual_scans_{bus.publisher(topics::kVirtualScan)} {
    auto limits = bus.publisher(topics::kLimits);
    docent_msgs::Limits limit;
    limit.mode = "open";
    limit.max_speed = max_speed;
    limits.publish(limit);
    bus.subscribe<nav_msgs::Odometry>(topics::kOdometry,
                                      [this](const auto& odometry) { here_ = from_message(odometry.pose.pose); });
    bus.subscribe<docent_msgs::TrueState>(topics::kTrueState, [this](const auto& state) {
      odom_from_hall_ = here_ * inverse(Pose2{state.x, state.y, Angle::radians(state.theta)});
    });
    bus.every(seconds(0.2), [this] {
      publish_virtual_scan();
      publish_target();
    });
  }
  void go() { goes_ = true; }

 private:
  void publish_virtual_scan() {
    sensor_msgs::LaserScan scan;
    scan.header = {to_message(bus_.now()), "base_link"};
    scan.angle_min = -std::numbers::pi_v<float>;
    scan.angle_increment = std::numbers::pi_v<float> / 90.0F;
    scan.range_max = 6.0F;
    scan.ranges.assign(180, scan.range_max);
    virtual_scans_.publish(std::move(scan));
  }
  /// Three metres of the way, as the planner gives.
  void publish_target() {
    docent_msgs::Target target;
    target.header = {to_message(bus_.now()), "odom"};
    target.goal_id = "across";
    target.mode = goes_ ? "drive" : "stop";
    target.position_tolerance = tolerance_;
    const Point2 goal = odom_from_hall_ * goal_in_hall_;
    const Point2 way = goal - here_.position();
    const double rest = norm(way);
    constexpr double kHorizon = 3.0;
    constexpr double kStep = 0.25;
    for (double along = 0.0; goes_ && along < std::min(rest, kHorizon); along += kStep) {
      const Point2 via = here_.position() + (along / rest) * way;
      target.via_x.push_back(via.x);
      target.via_y.push_back(via.y);
    }
    target.is_final = rest <= kHorizon;
    if (target.is_final) {
      target.via_x.push_back(goal.x);
      target.via_y.push_back(goal.y);
    }
    targets_.publish(std::move(target));
  }

  Bus& bus_;
  Point2 goal_in_hall_;
  double tolerance_;
  Publisher<docent_msgs::Target> targets_;
  Publisher<sensor_msgs::LaserScan> virtual_scans_;
  Pose2 here_;
  Pose2 odom_from_hall_;
  bool goes_ = false;
};

/// A crowd of ordinary visitors: none of them plays with the robot, so that what is measured is how it moves among
/// them. They look at cases for 8 to 40 s and go to the next one, with family or friends.
simulator::CrowdParams visitors(double ignoring) {
  simulator::CrowdParams params;
  params.ignoring_share = ignoring;
  params.dwell_min = 8.0;
  params.dwell_max = 40.0;
  params.follow_rate = params.curious_rate = params.block_rate = params.wall_rate = params.push_rate = 0.0;
  return params;
}

simulator::SimulationOptions simulation_of(const CrowdTrialOptions& options, const simulator::Hall& hall) {
  simulator::SimulationOptions simulation;
  simulation.world = hall.world;
  simulation.seed = options.seed;
  simulation.crowd = "empty";
  const double free_area = simulator::WalkableFloor{hall.world}.free_area();
  simulation.crowd_count = static_cast<std::size_t>(std::llround(options.density * free_area));
  simulation.crowd_params = visitors(options.ignoring);
  simulation.start = hall.start;
  simulation.requests_per_hour = 0.0;
  return simulation;
}

class Trial {
 public:
  Trial(const CrowdTrialOptions& options, const simulator::Hall& hall)
      : options_{options},
        simulation_{*world_, *truth_, simulation_of(options, hall)},
        courier_{*self_, hall.goal, 0.5 * options.goal_radius, options.max_speed},
        score_{time_from_seconds(options.settle_s), hall.goal, options.goal_radius, options.limit_s, kRobotRadius} {
    outcome_.hall = hall;
    outcome_.people = static_cast<int>(simulation_.people());
    outcome_.free_area = simulation_.free_area();
    truth_->subscribe<docent_msgs::TrueState>(topics::kTrueState, [this](const auto& state) { judge(state); });
    truth_->subscribe<docent_msgs::TrueContact>(topics::kTrueContact,
                                                [this](const auto& contact) { score_.add(contact); });
    self_->subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) { avoid_ = state; });
    self_->subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { ++outcome_.horns; });
  }

  Result<void> start_modules(const RobotConfig& config) {
    outcome_.config_hash = config.hash();
    for (const char* name : {"avoid", "robot"}) {
      ModuleHost::Options host;
      host.virtual_time = true;
      host.seed = options_.seed;
      auto module = ModuleHost::create(*find_module(name), hub_.connect(name), museum_, config, host);
      if (!module) return tl::unexpected<Error>(module.error());
      modules_.push_back(std::move(*module));
    }
    return {};
  }

  CrowdTrialOutcome run() {
    const Time begin = time_from_seconds(options_.settle_s);
    hub_.run_until(begin);
    courier_.go();
    while (!score_.is_over()) hub_.run_until(hub_.now() + seconds(1.0));
    hub_.run_until(hub_.now() + seconds(0.5));  // contacts are told late
    outcome_.report = score_.report();
    if (walking_samples_ > 0) outcome_.walking = walking_sum_ / walking_samples_;
    return std::move(outcome_);
  }

 private:
  void judge(const docent_msgs::TrueState& state) {
    const double time = to_seconds(from_message(state.header.stamp)) - options_.settle_s;
    const bool was_over = score_.is_over();
    score_.add(state);
    if (time < 0.0 || was_over) return;
    if (!state.people.empty()) {
      const auto walks = [](const auto& person) { return norm({person.vx, person.vy}) > 0.2; };
      walking_sum_ += static_cast<double>(std::count_if(state.people.begin(), state.people.end(), walks)) /
                      static_cast<double>(state.people.size());
      ++walking_samples_;
    }
    if (samples_++ % 10 == 0 || score_.is_over()) {
      outcome_.moments.push_back(
          {time, {state.x, state.y, Angle::radians(state.theta)}, state.linear, avoid_, state.people});
    }
  }

  CrowdTrialOptions options_;
  VirtualTimeHub hub_;
  Museum museum_;
  std::unique_ptr<Bus> world_ = hub_.connect("world");
  std::unique_ptr<Bus> truth_ = hub_.connect("truth");
  std::unique_ptr<Bus> self_ = hub_.connect("courier");
  simulator::SimulatedMuseum simulation_;
  Courier courier_;
  SocialScore score_;
  std::vector<std::unique_ptr<ModuleHost>> modules_;
  CrowdTrialOutcome outcome_;
  docent_msgs::AvoidState avoid_;
  int samples_ = 0;
  double walking_sum_ = 0.0;
  int walking_samples_ = 0;
};

}  // namespace

Result<CrowdTrialOutcome> run_crowd_trial(const CrowdTrialOptions& options) {
  RobotConfig config;
  for (const auto& setting : options.settings) {
    if (auto set = config.set(setting); !set) return tl::unexpected<Error>(set.error());
  }
  Trial trial{options, simulator::draw_hall(Rng{options.seed}.stream("hall"))};
  if (auto started = trial.start_modules(config); !started) return tl::unexpected<Error>(started.error());
  return trial.run();
}

Image draw_crowd_trial(const CrowdTrialOutcome& outcome) {
  constexpr double kScale = 70.0;  // pixels a metre
  Image image{static_cast<int>(14.4 * kScale), static_cast<int>(10.4 * kScale)};
  const auto pixel = [](Point2 in_world) { return Point2{(in_world.x + 0.2) * kScale, (10.2 - in_world.y) * kScale}; };
  const auto pixels = [&](const Polygon& polygon) {
    std::vector<Point2> corners;
    for (const Point2 corner : polygon) corners.push_back(pixel(corner));
    return corners;
  };
  for (const auto& solid : outcome.hall.world.solids) fill_polygon(image, pixels(solid.polygon), {70, 70, 80, 255});
  for (const auto& attraction : outcome.hall.world.attractions)
    draw_circle(image, pixel(attraction.centre), kScale * attraction.radius, 1.0, {200, 200, 210, 255});
  if (outcome.moments.empty()) return image;
  for (const auto& person : outcome.moments.back().people) {
    const Point2 at{person.x, person.y};
    fill_disc(image, pixel(at), kScale * static_cast<double>(person.radius), {120, 160, 220, 255});
    draw_line(image, pixel(at), pixel(at + Point2{person.vx, person.vy}), 2.0, {40, 80, 160, 255});
  }
  for (std::size_t i = 0; i < outcome.moments.size(); ++i) {
    const auto& moment = outcome.moments[i];
    if (i > 0)
      draw_line(image, pixel(outcome.moments[i - 1].robot.position()), pixel(moment.robot.position()), 2.0,
                {220, 120, 40, 255});
    const bool stands = std::abs(moment.speed) < 0.02;
    fill_disc(image, pixel(moment.robot.position()), 3.5, stands ? Color{220, 30, 30, 255} : Color{40, 160, 60, 255});
  }
  const Pose2& robot = outcome.moments.back().robot;
  draw_circle(image, pixel(robot.position()), kScale * kRobotRadius, 3.0, {220, 120, 40, 255});
  draw_arrow(image, pixel(robot.position()), pixel(robot * Point2{0.5, 0.0}), 3.0, {220, 120, 40, 255});
  draw_circle(image, pixel(outcome.hall.goal), 0.3 * kScale, 2.0, {40, 160, 60, 255});
  return image;
}

}  // namespace docent
