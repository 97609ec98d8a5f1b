#include "docent/apps/crowd_trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "docent/apps/simulated_hardware.h"
#include "docent/apps/temporary_folder.h"
#include "docent/messages/conversions.h"
#include "docent/modules/module_host.h"
#include "docent/modules/scanners.h"
#include "docent/pictures/drawing.h"
#include "docent/pictures/text.h"
#include "docent/sensor_models/ray_caster.h"
#include "docent/simulator/crowd/crowd.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/simulator/world/survey.h"
#include "docent/simulator/world/world_picture.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent {
namespace {

constexpr double kRobotRadius = 0.265;  // [m]

/// All that drives the robot but localization; nobody asks for tours here.
constexpr std::array kModules{"avoid", "hazards", "map", "plan", "robot", "executive"};

/// Stands for mission and operator: one drive to the other end of the hall.
class Errand {
 public:
  Errand(Bus& bus, double max_speed) : tasks_{bus.publisher(topics::kTask)} {
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
  Publisher<docent_msgs::Task> tasks_;
};

/// The hall as surveyed for the robot.
Museum museum_of(const simulator::Hall& hall, std::uint64_t seed) {
  Museum museum;
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
  Surveyor(Bus& bus, const Museum& museum, const RobotBody& body)
      : body_{body},
        walls_{museum.map},
        beliefs_{bus.publisher(topics::kBelief)},
        beams_{bus.publisher(topics::kPersonBeams)} {
    bus.subscribe<nav_msgs::Odometry>(
        topics::kOdometry, [this](const auto& odometry) { odom_from_base_ = from_message(odometry.pose.pose); });
    subscribe_scanners(bus, body_,
                       [this](std::size_t i, const auto& scan) { see(scan, body_.scanners[i].base_from_sensor()); });
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

  RobotBody body_;
  RayCaster walls_;
  Publisher<docent_msgs::Belief> beliefs_;
  Publisher<docent_msgs::PersonBeams> beams_;
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
                                           const RobotBody& body) {
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
  Trial(const CrowdTrialOptions& options, const simulator::Hall& hall, const RobotBody& body)
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

  Result<void> start_modules(const RobotConfig& config) {
    outcome_.config_hash = config.hash();
    outcome_.crippled = config.evaluation().crippled();
    for (const char* name : kModules) {
      ModuleHost::Options host;
      host.state = state_.path();
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
  VirtualTimeHub hub_;
  Museum museum_;
  std::unique_ptr<Bus> world_ = hub_.connect("world");
  std::unique_ptr<Bus> truth_ = hub_.connect("truth");
  std::unique_ptr<Bus> self_ = hub_.connect("errand");
  simulator::SimulatedMuseum simulation_;
  Errand errand_;
  Surveyor surveyor_;
  SocialScore score_;
  std::vector<std::unique_ptr<ModuleHost>> modules_;
  CrowdTrialOutcome outcome_;
  docent_msgs::AvoidState avoid_;
  std::vector<Point2> way_;
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
  Trial trial{options, simulator::draw_hall(Rng{options.seed}.stream("hall")), config.body()};
  if (auto started = trial.start_modules(config); !started) return tl::unexpected<Error>(started.error());
  return trial.run();
}

namespace {

/// Draws a hall, its corner 0.2 m off the picture's.
class HallPicture {
 public:
  HallPicture(const simulator::Hall& hall, double scale)
      : image_{static_cast<int>(14.4 * scale), static_cast<int>(10.4 * scale)}, scale_{scale} {
    for (const auto& solid : hall.world.solids) {
      std::vector<Point2> corners;
      for (const Point2 corner : solid.polygon) corners.push_back(pixel(corner));
      fill_polygon(image_, corners, {70, 70, 80, 255});
    }
    for (const auto& attraction : hall.world.attractions)
      draw_circle(image_, pixel(attraction.centre), scale * attraction.radius, 1.0, {200, 200, 210, 255});
    draw_circle(image_, pixel(hall.goal), 0.3 * scale, 2.0, {40, 160, 60, 255});
  }
  void draw(const std::vector<docent_msgs::TruePerson>& people) {
    for (const auto& person : people) {
      const Point2 at{person.x, person.y};
      fill_disc(image_, pixel(at), scale_ * static_cast<double>(person.radius), {120, 160, 220, 255});
      draw_line(image_, pixel(at), pixel(at + Point2{person.vx, person.vy}), 2.0, {40, 80, 160, 255});
    }
  }
  void draw(const Pose2& robot) {
    draw_circle(image_, pixel(robot.position()), scale_ * kRobotRadius, 3.0, {220, 120, 40, 255});
    draw_arrow(image_, pixel(robot.position()), pixel(robot * Point2{0.5, 0.0}), 3.0, {220, 120, 40, 255});
  }
  void draw_way(std::span<const Point2> way, Color color) {
    for (std::size_t i = 1; i < way.size(); ++i) draw_line(image_, pixel(way[i - 1]), pixel(way[i]), 2.0, color);
  }
  void mark(Point2 place, Color color) { fill_disc(image_, pixel(place), 3.5, color); }
  void label(const std::string& text) { draw_text(image_, {4.0, 1.0}, text, colors::kWhite); }
  [[nodiscard]] const Image& image() const { return image_; }

 private:
  [[nodiscard]] Point2 pixel(Point2 in_world) const {
    return {(in_world.x + 0.2) * scale_, (10.2 - in_world.y) * scale_};
  }
  Image image_;
  double scale_;  // pixels a metre
};

}  // namespace

Image draw_crowd_trial(const CrowdTrialOutcome& outcome) {
  HallPicture picture{outcome.hall, 70.0};
  if (outcome.moments.empty()) return picture.image();
  picture.draw(outcome.moments.back().people);
  for (std::size_t i = 0; i < outcome.moments.size(); ++i) {
    const auto& moment = outcome.moments[i];
    if (i > 0)
      picture.draw_way(std::array{outcome.moments[i - 1].robot.position(), moment.robot.position()},
                       {220, 120, 40, 255});
    const bool stands = std::abs(moment.speed) < 0.02;
    picture.mark(moment.robot.position(), stands ? Color{220, 30, 30, 255} : Color{40, 160, 60, 255});
  }
  picture.draw(outcome.moments.back().robot);
  return picture.image();
}

Image draw_crowd_strip(const CrowdTrialOutcome& outcome, std::size_t every) {
  constexpr int kColumns = 4;
  constexpr double kScale = 30.0;
  const int rows = static_cast<int>((outcome.moments.size() + every - 1) / every + kColumns - 1) / kColumns;
  const HallPicture hall{outcome.hall, kScale};
  Image strip{kColumns * hall.image().width(), std::max(1, rows) * hall.image().height()};
  int place = 0;
  for (std::size_t i = 0; i < outcome.moments.size(); i += every, ++place) {
    const auto& moment = outcome.moments[i];
    HallPicture picture = hall;
    picture.draw(moment.people);
    picture.draw_way(moment.way, {150, 60, 170, 255});
    picture.draw(moment.robot);
    picture.label(std::to_string(std::lround(moment.time)) + " s " + moment.avoid.reason);
    strip.paste(picture.image(), place % kColumns * hall.image().width(), place / kColumns * hall.image().height());
  }
  return strip;
}

}  // namespace docent
