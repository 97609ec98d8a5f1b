#include "turtlebot_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::turtlebot {
namespace {

constexpr double kObeys = 0.5;       // [s] after a command
constexpr double kMaxSpeed = 0.306;  // [m/s]
constexpr double kMaxTurn = 1.9;     // [rad/s]
constexpr double kWheels = 0.9;      // [m/s2]
constexpr double kTurning = 4.0;     // [rad/s2]
constexpr double kMayBack = 0.25;    // [m] that it backs off at most
constexpr double kSeesDock = 1.2;    // [m]
constexpr double kReach = 12.0;      // [m] of the scanner
constexpr double kNearest = 0.15;    // [m]
constexpr double kPressed = 0.01;    // [m] that a bumper gives way

double toward(double now, double wanted, double most) { return now + std::clamp(wanted - now, -most, most); }
double degrees(double value) { return value * std::numbers::pi / 180.0; }

}  // namespace

Body::Body(const Settings& settings)
    : settings_{settings}, rng_{settings.seed}, truth_{settings.map_from_robot}, is_docked_{settings.begins_docked} {}

void Body::command(double linear, double angular) {
  if (behaviour_ != Behaviour::none) {
    if (linear != 0.0 || angular != 0.0) commanded_s += 0.05;
    return;
  }
  wanted_linear_ = std::clamp(linear, -kMaxSpeed, kMaxSpeed);
  wanted_angular_ = std::clamp(angular, -kMaxTurn, kMaxTurn);
  since_command_ = 0.0;
}

bool Body::sees_dock() const {
  const Point2 dock = settings_.map_from_dock.position();
  return std::hypot(dock.x - truth_.x, dock.y - truth_.y) < kSeesDock;
}

bool Body::dock() {
  if (is_docked_ || behaviour_ != Behaviour::none || !sees_dock()) return false;
  behaviour_ = Behaviour::dock;
  phase_ = 0;
  return true;
}

bool Body::undock() {
  if (!is_docked_ || behaviour_ != Behaviour::none) return false;
  behaviour_ = Behaviour::undock;
  phase_ = 0;
  left_ = 0.35;
  target_ = truth_.theta + Angle::degrees(179.0);
  return true;
}

bool Body::is_free(Point2 at) const { return !settings_.world.is_occupied(settings_.world.frame.cell_at(at)); }

std::vector<double> Body::touches(double within) const {
  std::vector<double> bearings;
  const auto touch = [&](Point2 at) {
    const Point2 seen = inverse(truth_) * at;
    bearings.push_back(std::atan2(seen.y, seen.x));
  };
  for (int i = 0; i < 72; ++i) {
    const double bearing = degrees(5.0 * i);
    const Point2 rim = truth_ * Point2{(kRadius + within) * std::cos(bearing), (kRadius + within) * std::sin(bearing)};
    if (!is_free(rim)) touch(rim);
  }
  for (const Low& box : boxes) {
    const double apart = std::hypot(box.middle.x - truth_.x, box.middle.y - truth_.y);
    if (apart < box.radius + kRadius + within) touch(box.middle);
  }
  return bearings;
}

std::vector<std::string> Body::cliffs() const {
  struct Sensor {
    const char* frame;
    double bearing;
  };
  constexpr std::array kSensors{Sensor{"cliff_side_left", 60.0}, Sensor{"cliff_front_left", 17.0},
                                Sensor{"cliff_front_right", -17.0}, Sensor{"cliff_side_right", -60.0}};
  std::vector<std::string> found;
  for (const Sensor& sensor : kSensors) {
    const Point2 at =
        truth_ * Point2{0.155 * std::cos(degrees(sensor.bearing)), 0.155 * std::sin(degrees(sensor.bearing))};
    for (const Low& hole : holes)
      if (std::hypot(hole.middle.x - at.x, hole.middle.y - at.y) < hole.radius) {
        found.emplace_back(sensor.frame);
        break;
      }
  }
  return found;
}

std::vector<Body::Hazard> Body::hazards() const {
  std::vector<Hazard> all;
  if (is_lifted) {
    all.push_back({4, "wheel_drop_left"});
    all.push_back({4, "wheel_drop_right"});
    for (const char* frame : {"cliff_side_left", "cliff_front_left", "cliff_front_right", "cliff_side_right"})
      all.push_back({2, frame});
    return all;
  }
  constexpr std::array kBumpers{"bump_right", "bump_front_right", "bump_front_center", "bump_front_left", "bump_left"};
  for (const double bearing : touches(kPressed)) {
    if (std::abs(bearing) > degrees(95.0)) continue;  // it has no bumper behind
    const auto zone = std::clamp(static_cast<int>(std::floor((bearing + degrees(90.0)) / degrees(36.0))), 0, 4);
    const std::string frame = kBumpers[static_cast<std::size_t>(zone)];
    if (std::none_of(all.begin(), all.end(), [&](const Hazard& hazard) { return hazard.frame == frame; }))
      all.push_back({1, frame});
  }
  for (const std::string& frame : cliffs()) all.push_back({2, frame});
  if (backed_ <= 0.02) all.push_back({0, "base_link"});
  return all;
}

void Body::steer(double linear, double angular, double dt) {
  linear_ = toward(linear_, linear, kWheels * dt);
  angular_ = toward(angular_, angular, kTurning * dt);
  if (linear_ < 0.0 && backed_ <= 0.0 && behaviour_ == Behaviour::none) linear_ = 0.0;
  const Pose2 before = truth_;
  const auto move = [&](Pose2& pose, double scale) {
    const double middle = pose.theta.radians() + 0.5 * angular_ * scale * dt;
    pose = {pose.x + linear_ * scale * dt * std::cos(middle), pose.y + linear_ * scale * dt * std::sin(middle),
            Angle::radians(pose.theta.radians() + angular_ * scale * dt)};
  };
  move(truth_, 1.0);
  if (behaviour_ != Behaviour::dock && behaviour_ != Behaviour::undock) {
    for (const double bearing : touches(0.0)) {
      if (linear_ * std::cos(bearing) > 0.0) {  // against it, with its bumpers pressed in
        truth_.x = before.x;
        truth_.y = before.y;
        linear_ = 0.0;
        break;
      }
    }
  }
  if (truth_.x != before.x || truth_.y != before.y || angular_ != 0.0) move(odometry_, 1.0 + 0.005 * rng_.normal());
  backed_ = std::clamp(backed_ + linear_ * dt, -0.01, kMayBack);
}

bool Body::turn_to(Angle heading, double dt) {
  const double error = (heading - truth_.theta).radians();
  steer(0.0, std::clamp(2.0 * error, -1.0, 1.0), dt);
  return std::abs(error) < 0.02;
}

bool Body::drive_to(Point2 place, double speed, double dt) {
  const Point2 seen = inverse(truth_) * place;
  const double apart = std::hypot(seen.x, seen.y);
  steer(std::min(speed, 0.05 + apart), std::clamp(2.0 * std::atan2(seen.y, seen.x), -1.0, 1.0), dt);
  return apart < 0.02 || seen.x < 0.0;
}

void Body::behave(double dt) {
  const Pose2& dock = settings_.map_from_dock;
  if (behaviour_ == Behaviour::reflex) {
    steer(-0.1, 0.0, dt);
    left_ -= dt;
    if (left_ <= 0.0) behaviour_ = Behaviour::none;
  } else if (behaviour_ == Behaviour::undock) {
    is_docked_ = false;
    if (phase_ == 0) {
      steer(-0.1, 0.0, dt);
      left_ -= std::abs(linear_) * dt;
      if (left_ <= 0.0) phase_ = 1;
    } else if (turn_to(target_, dt)) {
      behaviour_ = Behaviour::none;
    }
  } else {
    const Point2 before = dock * Point2{-0.35, 0.0};
    const Point2 seen = inverse(truth_) * before;
    if (phase_ == 0) {
      if (std::hypot(seen.x, seen.y) < 0.05 || turn_to(truth_.theta + Angle::radians(std::atan2(seen.y, seen.x)), dt))
        phase_ = 1;
    } else if (phase_ == 1) {
      if (std::hypot(seen.x, seen.y) < 0.03 || drive_to(before, 0.15, dt)) phase_ = 2;
    } else if (phase_ == 2) {
      if (turn_to(dock.theta, dt)) phase_ = 3;
    } else if (drive_to(dock.position(), 0.08, dt)) {
      is_docked_ = true;
      behaviour_ = Behaviour::none;
    }
  }
  if (behaviour_ == Behaviour::none) {
    wanted_linear_ = wanted_angular_ = linear_ = angular_ = 0.0;
    since_command_ = 1e9;
  }
}

void Body::step(double dt) {
  battery = std::clamp(battery + dt * (is_docked_ ? 0.004 : -0.00005), 0.0, 1.0);
  since_command_ += dt;
  if (is_lifted) {
    linear_ = angular_ = 0.0;
    return;
  }
  // Its own reflex asks nobody: whoever hears the bumpers may have stopped it already.
  const bool comes_nearer = linear_ > 0.0 || (linear_ == 0.0 && wanted_linear_ > 0.0 && since_command_ < kObeys);
  if (behaviour_ == Behaviour::none && comes_nearer) {
    const auto felt = touches(kPressed);
    const bool is_edge = !cliffs().empty();
    const bool is_bump =
        std::any_of(felt.begin(), felt.end(), [](double bearing) { return std::abs(bearing) < degrees(95.0); });
    if (is_bump || is_edge) {
      bumps += is_bump ? 1 : 0;
      edges += is_edge ? 1 : 0;
      behaviour_ = Behaviour::reflex;
      left_ = 0.5;
    }
  }
  if (behaviour_ != Behaviour::none) return behave(dt);
  const bool obeys = since_command_ < kObeys;
  if (obeys && (wanted_linear_ > 0.01 || std::abs(wanted_angular_) > 0.05))
    is_docked_ = false;  // dragged off its contacts
  steer(obeys ? wanted_linear_ : 0.0, obeys ? wanted_angular_ : 0.0, dt);
}

std::vector<float> Body::scan(int beams, double mounted_x, double mounted_yaw) {
  std::vector<float> ranges(static_cast<std::size_t>(beams), std::numeric_limits<float>::infinity());
  const Point2 from = truth_ * Point2{mounted_x, 0.0};
  for (int i = 0; i < beams; ++i) {
    const double bearing = truth_.theta.radians() + mounted_yaw - std::numbers::pi + 2.0 * std::numbers::pi * i / beams;
    const double dx = std::cos(bearing), dy = std::sin(bearing);
    for (double range = kNearest; range < kReach; range += 0.01) {
      if (is_free({from.x + range * dx, from.y + range * dy})) continue;
      ranges[static_cast<std::size_t>(i)] = static_cast<float>(std::max(kNearest, range + rng_.normal(0.0, 0.01)));
      break;
    }
  }
  return ranges;
}

}  // namespace docent::turtlebot
