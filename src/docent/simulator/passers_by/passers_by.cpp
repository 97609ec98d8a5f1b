#include "docent/simulator/passers_by/passers_by.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::simulator {
namespace {

constexpr double kElbow = 0.35;          // [m] between the middle of a group and each of it
constexpr double kNearest = 0.35;        // [m] nobody stands in the robot
constexpr double kMostStop = 0.95;       // of all groups
constexpr double kPaceSpread = 0.2;      // share of the pace
constexpr double kDistanceSpread = 0.4;  // [m]

double warmth_of(Mood face) {
  switch (face) {
    case Mood::happy:
      return 1.0;
    case Mood::neutral:
      return 0.0;
    case Mood::sad:
      return -0.6;
    case Mood::angry:
      return -1.0;
  }
  return 0.0;
}

double warmth_of(SpeechAct speech) {
  switch (speech) {
    case SpeechAct::invite:
      return 1.0;
    case SpeechAct::ask:
      return 0.8;
    case SpeechAct::silence:
      return -0.1;
    case SpeechAct::demand:
      return -0.8;
    case SpeechAct::complain:
      return -1.0;
  }
  return 0.0;
}

}  // namespace

PassersBy::PassersBy(const PassersByParams& params, double density, const Rng& rng)
    : params_{params}, density_{density}, rng_{rng}, whim_{params.whim * rng_.normal()} {
  const double mean_size = 0.5 * (1.0 + params_.largest_group);
  const double groups = density_ * std::numbers::pi * params_.hall * params_.hall / mean_size;
  for (double left = rng_.exponential(1.0); left < groups; left += rng_.exponential(1.0)) {
    const double away = params_.hall * std::sqrt(rng_.uniform());
    const Point2 position = away * unit(Angle::radians(rng_.uniform(-std::numbers::pi, std::numbers::pi)));
    groups_.push_back(group_at(position, Angle::radians(rng_.uniform(-std::numbers::pi, std::numbers::pi))));
    if (away < params_.notice) groups_.back().errand = Errand::has_decided;  // it walked by before
  }
}

PassersBy::Group PassersBy::group_at(Point2 position, Angle heading) {
  Group group;
  group.position = position;
  const double pace = std::max(0.3, rng_.normal(params_.pace, kPaceSpread * params_.pace));
  group.velocity = pace * unit(heading);
  const auto size = rng_.integer(1, params_.largest_group);
  for (std::int64_t i = 0; i < size; ++i) {
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size);
    group.places.push_back(size == 1 ? Point2{} : kElbow * unit(Angle::radians(turn)));
  }
  return group;
}

/// So many that the density of those who walk by stays as it is: through a circle of diameter 2 R walk density * pace *
/// 2 R persons a second.
void PassersBy::arrive(double seconds) {
  const double mean_size = 0.5 * (1.0 + params_.largest_group);
  const double groups = density_ * params_.pace * 2.0 * params_.hall / mean_size * seconds;
  for (double left = rng_.exponential(1.0); left < groups; left += rng_.exponential(1.0)) {
    const Angle from = Angle::radians(rng_.uniform(-std::numbers::pi, std::numbers::pi));
    // Walkers of all directions and places cross a circle at angles whose sine is uniform.
    const double offset = std::asin(rng_.uniform(-1.0, 1.0));
    groups_.push_back(group_at(params_.hall * unit(from), from + Angle::radians(std::numbers::pi + offset)));
  }
}

double PassersBy::share_that_stops() const {
  const double warmth = 0.5 * (warmth_of(shown_.face) + warmth_of(shown_.speech));
  const double eyes = shown_.gaze == GazeStrategy::ahead ? 0.0 : params_.eye_contact;
  return std::min(kMostStop, params_.stops * std::exp(params_.liking * warmth + eyes + whim_));
}

void PassersBy::decide(Group& group) {
  group.errand = Errand::has_decided;
  if (!rng_.chance(share_that_stops())) return;
  group.errand = Errand::comes;
  group.stay_s = rng_.exponential(params_.stay_s);
  group.distance =
      rng_.chance(params_.pushy) ? kNearest : std::max(0.8, rng_.normal(params_.distance, kDistanceSpread));
}

void PassersBy::move(Group& group, double seconds) {
  const double away = norm(group.position);
  if (group.errand == Errand::passes && away < params_.notice) decide(group);
  if (group.errand == Errand::stands) {
    group.stay_s -= seconds;
    if (group.stay_s > 0.0) return;
    const Angle off = Angle::radians(rng_.uniform(-0.5, 0.5) * std::numbers::pi);
    group.velocity = norm(group.velocity) * unit(direction({}, group.position) + off);
    group.errand = Errand::has_decided;
  }
  if (group.errand == Errand::comes) {
    if (away <= group.distance) {
      group.errand = Errand::stands;
      return;
    }
    group.velocity = -norm(group.velocity) / std::max(away, kNearest) * group.position;
  }
  group.position = group.position + seconds * group.velocity;
}

void PassersBy::step(double seconds) {
  arrive(seconds);
  for (Group& group : groups_) move(group, seconds);
  std::erase_if(groups_, [&](const Group& group) { return norm(group.position) > params_.hall + kElbow; });
}

std::vector<Point2> PassersBy::people() const {
  std::vector<Point2> people;
  for (const Group& group : groups_)
    for (const Point2 place : group.places) people.push_back(group.position + place);
  return people;
}

}  // namespace docent::simulator
