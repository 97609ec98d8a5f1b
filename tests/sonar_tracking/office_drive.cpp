#include "office_drive.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "docent/simulator/body/body.h"
#include "docent/simulator/crowd/walkable_floor.h"

namespace docent {
namespace {

using simulator::Body;

constexpr double kStep = 0.01;      // [s]
constexpr int kCommandEvery = 5;    // steps
constexpr int kFireEvery = 5;       // steps: the whole ring every 0.4 s
constexpr double kArrived = 0.4;    // [m]
constexpr double kPatience = 90.0;  // [s] for one goal

class Joystick {
 public:
  Joystick(const simulator::WalkableFloor& floor, double max_speed, const Rng& rng)
      : floor_{floor}, max_speed_{max_speed}, rng_{rng} {}

  struct Velocity {
    double linear = 0.0;
    double angular = 0.0;
  };

  Velocity steer(double now, const Pose2& pose) {
    if (now < pause_until_) return {};
    if (!goal_ || distance(pose.position(), *goal_) < kArrived || now > give_up_) {
      if (goal_ && now <= give_up_) ++goals_;
      goal_ = floor_.random_point(rng_, 0.45);
      if (!goal_) return {};
      field_ = floor_.field_to(*goal_, 0.2);
      give_up_ = now + kPatience;
      pause_until_ = now + rng_.uniform(0.0, 3.0);
      return {};
    }
    const auto way = floor_.direction(field_, pose.position(), 0.33);
    if (!way) {
      give_up_ = now;
      return {};
    }
    // Ways are planned for people, on cells of 0.2 m: the robot's body keeps away from what is near.
    const double near = floor_.clearance(pose.position() + 0.15 * unit(pose.theta));
    const Point2 away = std::max(0.0, (0.42 - near) / 0.1) * floor_.away_from_walls(pose.position());
    const double off = (direction({}, *way + away) - pose.theta).radians();
    const double room = std::min(near, floor_.clearance(pose.position() + 0.5 * unit(pose.theta))) - 0.27;
    double linear = max_speed_ * std::clamp(room / 0.4, 0.1, 1.0);
    linear = std::min(linear, 0.2 + 0.8 * distance(pose.position(), *goal_)) * std::max(0.0, std::cos(1.6 * off));
    if (std::abs(off) > 0.9) linear = 0.0;
    return {linear, std::clamp(2.0 * off, -1.2, 1.2)};
  }
  [[nodiscard]] int goals() const { return goals_; }

 private:
  const simulator::WalkableFloor& floor_;
  double max_speed_;
  Rng rng_;
  std::optional<Point2> goal_;
  simulator::FlowField field_;
  double give_up_ = 0.0;
  double pause_until_ = 0.0;
  int goals_ = 0;
};

}  // namespace

OfficeDrive drive_through(const simulator::Office& office, double minutes, double max_speed, std::uint64_t seed) {
  const Rng rng = Rng{seed}.stream("office drive");
  const simulator::WalkableFloor floor{office.world};
  const simulator::RayCaster walls{simulator::sonar_surfaces(office.world)};
  Body body{{}, office.home, rng.stream("body")};
  simulator::SonarRing ring{{}, rng.stream("sonar")};
  Joystick joystick{floor, max_speed, rng.stream("joystick")};
  OfficeDrive drive;
  drive.sonars = ring.params();
  drive.kinds.assign(4, 0);
  bool touches = false;
  int moving = 0;
  const auto steps = static_cast<int>(std::lround(minutes * 60.0 / kStep));
  for (int step = 0; step < steps; ++step) {
    const double now = step * kStep;
    if (step % kCommandEvery == 0) {
      const auto velocity = joystick.steer(now, body.pose());
      body.command(time_from_seconds(now), velocity.linear, velocity.angular);
    }
    const Point2 before = body.pose().position();
    body.step(time_from_seconds(now), kStep, true);
    const double lacking = body.params().radius - floor.clearance(body.pose().position());
    if (lacking > 0.0) body.correct(body.pose().position() + lacking * floor.away_from_walls(body.pose().position()));
    if (lacking > 0.0 && !touches) ++drive.contacts;
    touches = lacking > 0.0;
    drive.metres += distance(before, body.pose().position());
    drive.max_speed = std::max(drive.max_speed, body.linear());
    if (std::abs(body.linear()) > 0.05 || std::abs(body.angular()) > 0.1) ++moving;
    if (step % kFireEvery != 0) continue;
    drive.events.push_back({now, body.odometry(), -1, 0.0});
    drive.truth.push_back(body.pose());
    const int group = step / kFireEvery * 3 % ring.groups();
    for (const auto& ping : ring.fire(group, walls, {}, body.pose())) {
      ++drive.kinds[static_cast<std::size_t>(ping.kind)];
      drive.events.push_back({now, body.odometry(), ping.index, ping.range});
      drive.truth.push_back(body.pose());
    }
  }
  drive.moving_share = static_cast<double>(moving) / std::max(1, steps);
  drive.goals = joystick.goals();
  return drive;
}

}  // namespace docent
