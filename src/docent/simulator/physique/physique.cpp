#include "docent/simulator/physique/physique.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kCrotch = 0.47;    // of the height; legs below, trunk above
constexpr double kHip = 0.05;       // of the height: from the middle to one leg
constexpr double kDepth = 0.085;    // of the height: half a trunk, arms and clothes included
constexpr double kForward = 0.025;  // [m] the trunk is ahead of the legs: a belly, hands
constexpr double kToes = 0.09;      // [m] ahead of the leg
constexpr double kFoot = 0.05;      // [m] radius
constexpr double kInstep = 0.09;    // [m] a foot is so high

void add_pair(Physique& physique, BodyPart part) {
  physique.parts.push_back(part);
  part.at.y = -part.at.y;
  part.swing = -part.swing;
  physique.parts.push_back(part);
}

void add_walker(Physique& physique, const Stature& stature, double at, Rng& rng) {
  const double leg = stature.is_child ? rng.uniform(0.045, 0.05) : rng.uniform(0.05, 0.07);
  const double hip = kHip * stature.height;
  const double crotch = kCrotch * stature.height;
  add_pair(physique, {{at, hip}, leg, 0.0, crotch, 1.0, false});
  add_pair(physique, {{at + kToes, hip}, kFoot, 0.0, kInstep, 1.0, false});
  const double depth = std::min(kDepth * stature.height, stature.radius);
  const double middle = at + kForward;
  physique.parts.push_back({{middle, 0.0}, depth, crotch, stature.height, 0.0, true});
  if (stature.radius > depth)
    add_pair(physique, {{middle, stature.radius - depth}, depth, crotch, stature.height, 0.0, true});
}

Aid draw_aid(const PhysiqueParams& params, Rng& rng) {
  double draw = rng.uniform();
  const auto falls = [&](double share) {
    draw -= share;
    return draw < 0.0;
  };
  if (falls(params.bag_share)) return Aid::bag;
  if (falls(params.rucksack_share)) return Aid::rucksack;
  if (falls(params.cane_share)) return Aid::cane;
  if (falls(params.pram_share)) return Aid::pram;
  return falls(params.wheelchair_share) ? Aid::wheelchair : Aid::none;
}

void add_bag(Physique& physique, const Stature& stature, Rng& rng) {
  const double side = rng.chance(0.5) ? 1.0 : -1.0;
  const double bottom = rng.uniform(0.3, 0.75);  // in the hand .. at the hip
  const double radius = rng.uniform(0.08, 0.13);
  physique.parts.push_back({{0.0, side * (stature.radius + 0.4 * radius)}, radius, bottom, bottom + 0.35, 0.0, false});
}

void add_rucksack(Physique& physique, const Stature& stature) {
  const double depth = kDepth * stature.height;
  physique.parts.push_back({{-depth - 0.05, 0.0}, 0.14, 0.6 * stature.height, 0.85 * stature.height, 0.0, false});
}

void add_cane(Physique& physique, const Stature& stature, Rng& rng) {
  const double side = rng.chance(0.5) ? 1.0 : -1.0;
  physique.parts.push_back({{0.15, side * (stature.radius + 0.02)}, 0.0125, 0.0, 0.9, -side, false});
}

/// Its wheels are low, its box begins above them. [m] from the middle between it and who pushes it.
void add_pram(Physique& physique) {
  add_pair(physique, {{0.02, 0.25}, 0.04, 0.0, 0.25, 0.0, false});
  add_pair(physique, {{0.50, 0.22}, 0.04, 0.0, 0.22, 0.0, false});
  physique.parts.push_back({{0.14, 0.0}, 0.22, 0.30, 1.0, 0.0, true});
  physique.parts.push_back({{0.38, 0.0}, 0.23, 0.30, 1.0, 0.0, true});
}

void add_wheelchair(Physique& physique) {
  physique.parts.push_back({{0.0, 0.0}, 0.26, 0.45, 1.3, 0.0, true});      // who sits in it
  physique.parts.push_back({{-0.10, 0.0}, 0.20, 0.25, 0.55, 0.0, false});  // the seat's frame
  for (const double x : {-0.32, -0.12, 0.08})
    add_pair(physique, {{x, 0.29}, 0.045, 0.0, 0.58, 0.0, false});    // the large wheels
  add_pair(physique, {{0.34, 0.10}, 0.065, 0.08, 0.52, 0.0, false});  // shins
  add_pair(physique, {{0.46, 0.10}, 0.06, 0.05, 0.15, 0.0, false});   // feet on their rests
}

void find_reach(Physique& physique) {
  physique.reach = 0.0;
  for (const BodyPart& part : physique.parts)
    physique.reach =
        std::max(physique.reach, norm(part.at) + part.radius + 0.5 * physique.stance * std::abs(part.swing));
}

}  // namespace

std::optional<Bodies> bodies_of(std::string_view word) {
  if (word == "legs") return Bodies::legs;
  if (word == "discs") return Bodies::discs;
  return std::nullopt;
}

Physique one_disc(double radius) {
  Physique physique;
  physique.parts.push_back({{}, radius, 0.0, 2.0, 0.0, true});
  physique.reach = radius;
  return physique;
}

Physique draw_physique(const PhysiqueParams& params, const Stature& stature, Rng& rng) {
  if (params.bodies == Bodies::discs) return one_disc(stature.radius);
  Physique physique;
  physique.stance = (stature.is_child ? 0.7 : 1.0) * rng.uniform(0.25, 0.35);
  physique.aid = stature.is_child ? Aid::none : draw_aid(params, rng);
  constexpr double kBehindThePram = -0.36;  // [m]
  constexpr double kTurnsOnWheels = 1.5;    // [rad/s]
  if (physique.aid == Aid::pram || physique.aid == Aid::wheelchair) physique.turn_rate = kTurnsOnWheels;
  if (physique.aid == Aid::wheelchair) {
    add_wheelchair(physique);
  } else {
    add_walker(physique, stature, physique.aid == Aid::pram ? kBehindThePram : 0.0, rng);
  }
  if (physique.aid == Aid::bag) add_bag(physique, stature, rng);
  if (physique.aid == Aid::rucksack) add_rucksack(physique, stature);
  if (physique.aid == Aid::cane) add_cane(physique, stature, rng);
  if (physique.aid == Aid::pram) add_pram(physique);
  find_reach(physique);
  return physique;
}

double room_of(const Physique& physique, double radius) {
  if (physique.aid == Aid::pram) return std::max(radius, 0.42);
  if (physique.aid == Aid::wheelchair) return std::max(radius, 0.38);
  return radius;
}

void Gait::walk(Point2 velocity, double dt, const Physique& physique) {
  constexpr double kStands = 0.15;     // [m/s] below: a shifted weight, no way to face
  constexpr double kFullStride = 0.5;  // [m/s] from here on steps are full
  constexpr double kDrawsIn = 0.6;     // [m/s] with which legs come together and apart
  const double speed = norm(velocity);
  if (speed > kStands) {
    const double most = physique.turn_rate * dt;
    const double across = cross(facing_, velocity);
    const double along = dot(facing_, velocity);
    if (std::abs(across) <= most * along) {  // within the turn, for tan(most) is more: they walk as they face
      facing_ = (1.0 / speed) * velocity;
    } else {
      const double turn = std::clamp(std::atan2(across, along), -most, most);
      const Point2 left{-facing_.y, facing_.x};
      facing_ = std::cos(turn) * facing_ + std::sin(turn) * left;
      facing_ = (1.0 / norm(facing_)) * facing_;
    }
  }
  const double wanted = speed > kStands ? 0.5 * physique.stance * std::min(1.0, speed / kFullStride) : 0.0;
  spread_ += std::clamp(wanted - spread_, -kDrawsIn * dt, kDrawsIn * dt);
  phase_ += speed * dt / (2.0 * physique.stance);
  if (phase_ >= 1.0) phase_ -= std::floor(phase_);
  // The left leg falls back evenly for one step, as the floor does under a body, and comes forward in the next.
  swing_ = spread_ * (phase_ < 0.5 ? 1.0 - 4.0 * phase_ : 4.0 * phase_ - 3.0);
}

}  // namespace docent::simulator
