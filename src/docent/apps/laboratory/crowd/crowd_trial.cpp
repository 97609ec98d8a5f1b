#include "docent/apps/laboratory/crowd/crowd_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>

#include "docent/apps/shared/simulated_hardware.h"
#include "docent/apps/shared/temporary_folder.h"
#include "docent/messages/conversions.h"
#include "docent/modules/host/module_host.h"
#include "docent/modules/shared/scanners.h"
#include "docent/pictures/map_picture.h"
#include "docent/sensor_models/ray_caster.h"
#include "docent/simulator/crowd/crowd.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/simulator/world/survey.h"
#include "docent/simulator/world/world_picture.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::crowd_command {
namespace {

constexpr double kRobotRadius = 0.265;  // [m]

/// All that drives the robot but localization; nobody asks for tours here.
constexpr std::array kModules{"avoid", "hazards", "map", "plan", "robot", "executive"};

/// Stands for mission and operator: one drive to the other end of the hall.
class Errand {
 public:
  Errand(transport::Bus& bus, double max_speed) : tasks_{bus.publisher(topics::kTask)} {
    docent_msgs::Limits limit;
    limit.mode = "open";
    limit.max_speed = max_speed;
    bus.publisher(topics::kLimits).publish(limit);
  }
  void go(Point2 goal) {
    docent_msgs::Task task;
    task.id = "across";
    task.kind = "home";
    task.x = goal.x;
    task.y = goal.y;
    task.language = "en";
    tasks_.publish(task);
  }

 private:
  transport::Publisher<docent_msgs::Task> tasks_;
};

/// The hall as surveyed for the robot.
museum::Museum museum_of(const simulator::Hall& hall, std::uint64_t seed) {
  museum::Museum museum;
  museum.map = simulator::survey(hall.world, {}, Rng{seed}.stream("survey")).map;
  museum.area = hall.world.operating_area;
  museum.home = hall.start;
  museum.languages = {"en"};
  return museum;
}

/// Stands for localization, which is measured elsewhere: knows the place to a few centimetres, and which readings lie
/// where the map has nothing.
class Surveyor {
 public:
  Surveyor(transport::Bus& bus, const museum::Museum& museum, const robot::RobotBody& body)
      : body_{body},
        walls_{museum.map},
        beliefs_{bus.publisher(topics::kBelief)},
        beams_{bus.publisher(topics::kPersonBeams)} {
    bus.subscribe<nav_msgs::Odometry>(
        topics::kOdometry, [this](const auto& odometry) { odom_from_base_ = from_message(odometry.pose.pose); });
    modules::subscribe_scanners(
        bus, body_, [this](std::size_t i, const auto& scan) { see(scan, body_.scanners[i].base_from_sensor()); });
  }
  void know(const docent_msgs::TrueState& truth) {
    map_from_base_ = Pose2{truth.x, truth.y, Angle::radians(truth.theta)};
    docent_msgs::Belief belief;
    belief.header = {truth.header.stamp, "map"};
    belief.localized = true;
    belief.p_lost = 0.0;
    belief.odom_pose = to_message(odom_from_base_);
    belief.hypotheses.push_back({truth.x, truth.y, truth.theta, {0.0009, 0, 0, 0, 0.0009, 0, 0, 0, 0.0003}, 1.0});
    for (const double x : {-0.03, 0.0, 0.03})
      for (const double y : {-0.03, 0.0, 0.03})
        belief.cells.push_back({static_cast<float>(truth.x + x), static_cast<float>(truth.y + y),
                                static_cast<float>(truth.theta), 1.0F / 9.0F});
    beliefs_.publish(std::move(belief));
  }

 private:
  void see(const sensor_msgs::LaserScan& scan, const Pose2& base_from_laser) {
    if (!map_from_base_) return;
    constexpr float kOffTheWall = 0.3F;  // [m]
    docent_msgs::PersonBeams beams;
    beams.header = {scan.header.stamp, "base_link"};
    beams.localized = true;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const float range = scan.ranges[i];
      if (!std::isfinite(range) || range >= scan.range_max) continue;
      const double bearing =
          static_cast<double>(scan.angle_min) + static_cast<double>(i) * static_cast<double>(scan.angle_increment);
      const Point2 end = base_from_laser * (static_cast<double>(range) * unit(Angle::radians(bearing)));
      if (walls_.clearance(*map_from_base_ * end) < kOffTheWall) continue;
      beams.x.push_back(static_cast<float>(end.x));
      beams.y.push_back(static_cast<float>(end.y));
    }
    beams_.publish(std::move(beams));
  }

  robot::RobotBody body_;
  sensor_models::RayCaster walls_;
  transport::Publisher<docent_msgs::Belief> beliefs_;
  transport::Publisher<docent_msgs::PersonBeams> beams_;
  Pose2 odom_from_base_;
  std::optional<Pose2> map_from_base_;
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

simulator::SimulationOptions simulation_of(const CrowdTrialOptions& options, const simulator::Hall& hall,
                                           const robot::RobotBody& body) {
  simulator::SimulationOptions simulation;
  simulation.hardware = simulated_hardware(body);
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
  Trial(const CrowdTrialOptions& options, const simulator::Hall& hall, const robot::RobotBody& body)
      : options_{options},
        museum_{museum_of(hall, options.seed)},
        simulation_{*world_, *truth_, simulation_of(options, hall, body)},
        errand_{*self_, options.max_speed},
        surveyor_{*self_, museum_, body},
        score_{time_from_seconds(options.settle_s), hall.goal, options.goal_radius, options.limit_s, kRobotRadius} {
    outcome_.hall = hall;
    outcome_.people = static_cast<int>(simulation_.people());
    outcome_.free_area = simulation_.free_area();
    truth_->subscribe<docent_msgs::TrueState>(topics::kTrueState, [this](const auto& state) {
      judge(state);
      surveyor_.know(state);
    });
    truth_->subscribe<docent_msgs::TrueContact>(topics::kTrueContact,
                                                [this](const auto& contact) { score_.add(contact); });
    self_->subscribe<docent_msgs::AvoidState>(topics::kAvoidState, [this](const auto& state) { avoid_ = state; });
    self_->subscribe<nav_msgs::Path>(topics::kPath, [this](const auto& path) {
      way_.clear();
      for (const auto& pose : path.poses) way_.push_back(from_message(pose.pose).position());
    });
    self_->subscribe<docent_msgs::Horn>(topics::kHorn, [this](const auto&) { ++outcome_.horns; });
  }

  Result<void> start_modules(const robot::RobotConfig& config) {
    outcome_.config_hash = config.hash();
    outcome_.crippled = options_.robot_maker->crippled();
    for (const char* name : kModules) {
      modules::ModuleHost::Options host;
      host.state = state_.path();
      host.virtual_time = true;
      host.seed = options_.seed;
      auto module = options_.robot_maker->make(*modules::find_module(name), hub_.connect(name), museum_, config, host);
      if (!module) return tl::unexpected<Error>(module.error());
      modules_.push_back(std::move(*module));
    }
    return {};
  }

  CrowdTrialOutcome run() {
    const Time begin = time_from_seconds(options_.settle_s);
    hub_.run_until(begin);
    errand_.go(outcome_.hall.goal);
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
          {time, {state.x, state.y, Angle::radians(state.theta)}, state.linear, avoid_, state.people, way_});
    }
  }

  CrowdTrialOptions options_;
  TemporaryFolder state_;
  transport::VirtualTimeHub hub_;
  museum::Museum museum_;
  std::unique_ptr<transport::Bus> world_ = hub_.connect("world");
  std::unique_ptr<transport::Bus> truth_ = hub_.connect("truth");
  std::unique_ptr<transport::Bus> self_ = hub_.connect("errand");
  simulator::SimulatedMuseum simulation_;
  Errand errand_;
  Surveyor surveyor_;
  evaluation::SocialScore score_;
  std::vector<std::unique_ptr<modules::ModuleHost>> modules_;
  CrowdTrialOutcome outcome_;
  docent_msgs::AvoidState avoid_;
  std::vector<Point2> way_;
  int samples_ = 0;
  double walking_sum_ = 0.0;
  int walking_samples_ = 0;
};

}  // namespace

Result<CrowdTrialOutcome> run_crowd_trial(const CrowdTrialOptions& options) {
  robot::RobotConfig config;
  for (const auto& setting : options.settings) {
    if (auto set = config.set(setting); !set) return tl::unexpected<Error>(set.error());
  }
  if (auto read = options.robot_maker->read(config); !read) return tl::unexpected<Error>(read.error());
  Trial trial{options, simulator::draw_hall(Rng{options.seed}.stream("hall")), config.body()};
  if (auto started = trial.start_modules(config); !started) return tl::unexpected<Error>(started.error());
  return trial.run();
}

namespace {

constexpr pictures::Color kSolid{70, 70, 80};
constexpr pictures::Color kNear{200, 200, 210};
constexpr pictures::Color kGoalColor{40, 160, 60};
constexpr pictures::Color kPerson{120, 160, 220};
constexpr pictures::Color kVelocity{40, 80, 160};
constexpr pictures::Color kRobot{220, 120, 40};
constexpr pictures::Color kStands{220, 30, 30};
constexpr pictures::Color kDrives{40, 160, 60};
constexpr pictures::Color kPlanned{150, 60, 170};
constexpr double kDot = 3.5;           // [points]
constexpr double kGoalRadius = 0.3;    // [m], as drawn
constexpr double kArrowLength = 0.5;   // [m]
constexpr double kStandsStill = 0.05;  // [m/s]

/// All of the hall, with 20 cm around it.
pictures::Axes hall_axes(const simulator::Hall& hall, double longest_side) {
  pictures::Axes axes = pictures::Axes::metres({-0.2, -0.2}, {14.2, 10.2}, longest_side);
  for (const auto& solid : hall.world.solids)
    axes.add([corners = axes.page(solid.polygon)](pictures::Canvas& canvas) { canvas.fill_polygon(corners, kSolid); });
  const auto ring = [&axes](Point2 centre, double radius, double width, pictures::Color color) {
    axes.add([=, at = axes.page(centre), points = radius * axes.scale()](pictures::Canvas& canvas) {
      canvas.draw_circle(at, points, width, color);
    });
  };
  for (const auto& attraction : hall.world.attractions) ring(attraction.centre, attraction.radius, 0.6, kNear);
  ring(hall.goal, kGoalRadius, 1.2, kGoalColor);
  return axes;
}

void draw_people(pictures::Axes& axes, const std::vector<docent_msgs::TruePerson>& people) {
  for (const auto& person : people) {
    const Point2 at{person.x, person.y};
    const Point2 places[] = {at};
    pictures::draw_points(axes, places, 2.0 * axes.scale() * static_cast<double>(person.radius), kPerson);
    if (norm({person.vx, person.vy}) < kStandsStill) continue;
    const Point2 velocity[] = {at, at + Point2{person.vx, person.vy}};
    pictures::draw_path(axes, velocity, 1.0, kVelocity);
  }
}

void draw_true_robot(pictures::Axes& axes, const Pose2& robot) {
  axes.add([centre = axes.page(robot.position()), front = axes.page(robot * Point2{kArrowLength, 0.0}),
            radius = kRobotRadius * axes.scale()](pictures::Canvas& canvas) {
    canvas.draw_circle(centre, radius, 1.5, kRobot);
    canvas.draw_arrow(centre, front, 1.5, kRobot);
  });
}

void add_hall_legend(pictures::Figure& figure) {
  figure.add_legend(pictures::legend_area("solid", kSolid));
  figure.add_legend(pictures::legend_ring("people stand within to look", 9.0, 0.6, kNear));
  figure.add_legend(pictures::legend_ring("goal", 9.0, 1.2, kGoalColor));
  figure.add_legend(pictures::legend_disc("person", 7.0, kPerson));
  figure.add_legend(pictures::legend_line("way of a person in the next second", 1.0, kVelocity));
  figure.add_legend(pictures::legend_ring("robot", 8.0, 1.5, kRobot));
}

}  // namespace

pictures::Figure draw_crowd_trial(const CrowdTrialOutcome& outcome) {
  std::array<char, 80> title{};
  const double end = outcome.moments.empty() ? 0.0 : outcome.moments.back().time;
  std::snprintf(title.data(), title.size(), "Driven from 0 to %.1f s, people at %.1f s", end, end);
  pictures::Figure figure{title.data()};
  pictures::Axes& axes = figure.add(hall_axes(outcome.hall, 480.0));
  add_hall_legend(figure);
  if (outcome.moments.empty()) return figure;
  draw_people(axes, outcome.moments.back().people);
  std::vector<Point2> way;
  std::vector<Point2> standing;
  std::vector<Point2> driving;
  for (const auto& moment : outcome.moments) {
    way.push_back(moment.robot.position());
    (std::abs(moment.speed) < 0.02 ? standing : driving).push_back(moment.robot.position());
  }
  pictures::draw_path(axes, way, 1.2, kRobot);
  pictures::draw_points(axes, driving, kDot, kDrives);
  pictures::draw_points(axes, standing, kDot, kStands);
  draw_true_robot(axes, outcome.moments.back().robot);
  figure.add_legend(pictures::legend_line("trajectory", 1.2, kRobot));
  figure.add_legend(pictures::legend_disc("driving, once a second", kDot, kDrives));
  figure.add_legend(pictures::legend_disc("standing, once a second", kDot, kStands));
  return figure;
}

pictures::Figure draw_crowd_strip(const CrowdTrialOutcome& outcome, std::size_t every) {
  constexpr std::size_t kColumns = 4;
  constexpr double kSide = 216.0;  // [points]
  pictures::Figure figure{""};
  for (std::size_t i = 0, place = 0; i < outcome.moments.size(); i += every, ++place) {
    const auto& moment = outcome.moments[i];
    pictures::Axes& axes = figure.add(hall_axes(outcome.hall, kSide), place % kColumns == 0);
    axes.set_title(std::to_string(std::lround(moment.time)) + " s " + moment.avoid.reason);
    draw_people(axes, moment.people);
    pictures::draw_path(axes, moment.way, 1.0, kPlanned);
    draw_true_robot(axes, moment.robot);
  }
  add_hall_legend(figure);
  figure.add_legend(pictures::legend_line("way planned", 1.0, kPlanned));
  return figure;
}

}  // namespace docent::apps::crowd_command
