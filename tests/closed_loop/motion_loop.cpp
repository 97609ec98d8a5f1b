#include "motion_loop.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "docent/apps/laboratory/ablations/crippled_robot.h"
#include "docent/base/check.h"
#include "docent/museum/museum.h"

namespace docent {

namespace {

template <class T>
T must(Result<T> result) {
  if (!result) std::fprintf(stderr, "%s\n", result.error().message.c_str());
  DOCENT_CHECK(result);
  return std::move(*result);
}

/// An error that wanders: Ornstein-Uhlenbeck with a time constant of 5 s.
class WanderingError {
 public:
  WanderingError(double deviation, Rng rng) : deviation_{deviation}, rng_{rng}, value_{rng_.normal(0.0, deviation)} {}
  double step(double dt) {
    const double keep = std::exp(-dt / 5.0);
    value_ = keep * value_ + deviation_ * std::sqrt(1.0 - keep * keep) * rng_.normal();
    return value_;
  }

 private:
  double deviation_;
  Rng rng_;
  double value_;
};

}  // namespace

class MotionLoop::Impl {
 public:
  explicit Impl(const Options& options)
      : museum_{must(museum::load_museum(options.museum))},
        rng_{Rng{options.seed}.stream("motion loop")},
        x_error_{options.position_error, rng_.stream("x")},
        y_error_{options.position_error, rng_.stream("y")},
        heading_error_{options.heading_error, rng_.stream("heading")} {
    for (const auto& setting : options.settings) DOCENT_CHECK(config_.set(setting));
    DOCENT_CHECK(robot_.read(config_));
    simulator::SimulationOptions simulation;
    simulation.world = must(simulator::load_world(*museum_.simulation_path));
    simulation.seed = options.seed;
    simulation.crowd = options.crowd;
    simulation.scenario = options.scenario;
    simulation.requests_per_hour = 0.0;
    simulation_ = std::make_unique<simulator::SimulatedMuseum>(*world_, *truth_, simulation);
    for (const char* name : {"avoid", "hazards", "robot", "map", "plan"}) {
      modules::ModuleHost::Options host;
      host.virtual_time = true;
      host.seed = options.seed;
      host.state = std::filesystem::temp_directory_path();
      modules_.push_back(must(robot_.make(*modules::find_module(name), hub_.connect(name), museum_, config_, host)));
    }
    listen();
    self_->every(seconds(0.1), [this] { localize(); });
    self_->every(seconds(0.5), [this] { lead(); });
  }

  void run(double duration) { hub_.run_until(hub_.now() + seconds(duration)); }

  const Outcome& outcome() {
    outcome_.seconds = to_seconds(hub_.now());
    const auto cost = [&](const char* name) {
      return 1e3 * hub_.costs().find(name)->second.total_s / outcome_.seconds;
    };
    outcome_.avoid_cost_ms = cost("avoid");
    outcome_.hazards_cost_ms = cost("hazards");
    return outcome_;
  }

 private:
  void listen() {
    self_->subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& message) { odometry_ = message; });
    self_->subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& message) { avoid_ = message; });
    self_->subscribe<docent_msgs::GoalState>(topics::kGoalState,
                                             [this](const auto& message) { goal_state_ = message; });
    self_->subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { ++outcome_.horns; });
    self_->subscribe<docent_msgs::TrueState>(topics::kTrueState, [this](const auto& message) { judge(message); });
    self_->subscribe<docent_msgs::TrueContact>(topics::kTrueContact, [this](const auto& contact) {
      std::string kind = contact.kind;
      if (kind == "people" &&
          (contact.robot_speed <= 0.1 || (contact.braked_in_time && contact.other_speed > contact.robot_speed))) {
        kind = "bumped";
      }
      ++outcome_.contacts[kind];
      if (kind == "bumped") return;
      char line[300];
      std::snprintf(
          line, sizeof line,
          "%.1f s: %s %s at (%.2f, %.2f), robot (%.2f, %.2f, %.0f) %.2f m/s, towards %.2f, other %.2f, in time %d; "
          "command %.2f %.2f cap %.2f '%s'",
          to_seconds(hub_.now()), kind.c_str(), contact.what.c_str(), contact.x, contact.y, true_.x, true_.y,
          Angle::radians(true_.theta).degrees(), contact.wheel_speed, contact.robot_speed, contact.other_speed,
          static_cast<int>(contact.braked_in_time), avoid_.linear, avoid_.angular, avoid_.speed_cap,
          avoid_.reason.c_str());
      outcome_.log.emplace_back(line);
    });
  }

  /// A belief as the localizer gives: after motion or time, 15 cm cells of 2 degrees, a Gaussian about a wrong place.
  void localize() {
    const Pose2 truth = simulation_->world_from_base();
    const double dx = x_error_.step(0.1);
    const double dy = y_error_.step(0.1);
    const double dtheta = heading_error_.step(0.1);
    const Pose2 odom = from_message(odometry_.pose.pose);
    const Pose2 moved = inverse(last_odom_) * odom;
    const double since = to_seconds(hub_.now() - last_belief_);
    const bool is_due = norm(moved.position()) > 0.1 || std::abs(moved.theta.degrees()) > 5.0 || since > 2.0 ||
                        (since > 1.0 && (norm(moved.position()) > 0.01 || std::abs(moved.theta.degrees()) > 0.5));
    if (!is_due) return;
    last_odom_ = odom;
    last_belief_ = hub_.now();
    const Pose2 mean{truth.x + dx, truth.y + dy, truth.theta + Angle::radians(dtheta)};
    constexpr double kCell = 0.15;
    constexpr double kStep = 0.0349066;
    docent_msgs::Belief belief;
    belief.header = {to_message(hub_.now()), "map"};
    belief.cell_size = static_cast<float>(kCell);
    belief.heading_step = static_cast<float>(kStep);
    double total = 0.0;
    for (int i = -3; i <= 3; ++i) {
      for (int k = -3; k <= 3; ++k) {
        for (int j = -2; j <= 2; ++j) {
          const double x = kCell * (std::floor(mean.x / kCell) + 0.5 + i);
          const double y = kCell * (std::floor(mean.y / kCell) + 0.5 + k);
          const double theta = kStep * (std::round(mean.theta.radians() / kStep) + j);
          const double away = (std::pow(x - mean.x, 2) + std::pow(y - mean.y, 2)) / (2 * 0.07 * 0.07);
          const double turned = std::pow((theta - mean.theta.radians()) / 0.03, 2) / 2.0;
          const double mass = std::exp(-away - turned);
          if (mass < 1e-5) continue;
          belief.cells.push_back(
              {static_cast<float>(x), static_cast<float>(y), static_cast<float>(theta), static_cast<float>(mass)});
          total += mass;
        }
      }
    }
    for (auto& cell : belief.cells) cell.mass = static_cast<float>(cell.mass / total);
    belief.hypotheses.push_back({mean.x, mean.y, mean.theta.radians(), {}, 1.0});
    belief.p_lost = 0.0;
    belief.localized = true;
    belief.odom_pose = to_message(odom);
    belief_.publish(std::move(belief));
  }

  void lead() {
    const Time now = hub_.now();
    if (now < seconds_until_) return;
    const bool is_mine = goal_state_.id == goal_.id && !goal_.id.empty();
    if (is_mine && goal_state_.state == "arrived") {
      ++outcome_.arrived;
      goal_ = {};
      goals_.publish(goal_);
      seconds_until_ = now + seconds(3.0);
      return;
    }
    const bool is_hopeless = to_seconds(now - goal_since_) > 240.0;
    if (!goal_.id.empty() && !is_hopeless) return;
    if (is_hopeless && !goal_.id.empty()) {
      ++outcome_.given_up;
      char line[300];
      std::snprintf(line, sizeof line,
                    "%.1f s: gave up %s at (%.2f, %.2f, %.0f): plan %s %.1f m, avoid %s '%s' near %.2f %.2f",
                    to_seconds(now), goal_.id.c_str(), true_.x, true_.y, Angle::radians(true_.theta).degrees(),
                    goal_state_.state.c_str(), goal_state_.remaining_m, avoid_.state.c_str(), avoid_.reason.c_str(),
                    avoid_.nearest_real_m, avoid_.nearest_virtual_m);
      outcome_.log.emplace_back(line);
    }
    const auto& exhibit = museum_.exhibits[static_cast<std::size_t>(
        rng_.integer(0, static_cast<std::int64_t>(museum_.exhibits.size()) - 1))];
    if (exhibit.web_only) return;
    goal_.id = exhibit.id + "-" + std::to_string(++goal_number_);
    goal_.x = exhibit.pose.x;
    goal_.y = exhibit.pose.y;
    goal_.theta = exhibit.pose.theta.radians();
    goal_since_ = now;
    goals_.publish(goal_);
  }

  void judge(const docent_msgs::TrueState& state) {
    const double dt = 0.1;
    true_ = state;
    outcome_.distance = state.distance_m;
    outcome_.top_speed = std::max(outcome_.top_speed, state.linear);
    if (!state.inside_area) outcome_.seconds_outside += dt;
    if (goal_.id.empty()) return;
    outcome_.goal_seconds += dt;
    if (std::abs(state.linear) < 0.02 && std::abs(state.angular) < 0.05) {
      standstill_ += dt;
      outcome_.standing[avoid_.state + ": " + avoid_.reason] += dt;
      if (standstill_ > outcome_.longest_standstill) outcome_.longest_standstill = standstill_;
    } else {
      standstill_ = 0.0;
    }
  }

  transport::VirtualTimeHub hub_;
  museum::Museum museum_;
  robot::RobotConfig config_;
  apps::ablations::CrippledRobot robot_;
  Rng rng_;
  WanderingError x_error_, y_error_, heading_error_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  std::unique_ptr<transport::Bus> truth_ = hub_.connect("truth");
  std::unique_ptr<transport::Bus> self_ = hub_.connect("loop");
  std::unique_ptr<simulator::SimulatedMuseum> simulation_;
  std::vector<std::unique_ptr<modules::ModuleHost>> modules_;
  transport::Publisher<docent_msgs::Belief> belief_ = self_->publisher(topics::kBelief);
  transport::Publisher<docent_msgs::DriveGoal> goals_ = self_->publisher(topics::kDriveGoal);
  nav_msgs::Odometry odometry_;
  docent_msgs::AvoidState avoid_;
  docent_msgs::GoalState goal_state_;
  docent_msgs::TrueState true_;
  docent_msgs::DriveGoal goal_;
  int goal_number_ = 0;
  Time goal_since_{};
  Time seconds_until_{};
  Pose2 last_odom_;
  Time last_belief_{-10000000000};
  double standstill_ = 0.0;
  Outcome outcome_;
};

MotionLoop::MotionLoop(const Options& options) : impl_{std::make_unique<Impl>(options)} {}
MotionLoop::~MotionLoop() = default;
void MotionLoop::run(double duration) { impl_->run(duration); }
const MotionLoop::Outcome& MotionLoop::outcome() { return impl_->outcome(); }

}  // namespace docent
