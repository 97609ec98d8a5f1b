#include "docent/localization/judgement/rivals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::localization {
namespace {

constexpr double kFar = 3.0;            // [m] nearer is the same place
constexpr double kTurned = 60.0;        // [deg]
constexpr double kWorthMention = 2e-3;  // of the best mode's mass: a mode that is followed
constexpr double kFairShare = 0.25;     // of the best mode's mass, for a place that nothing speaks against
constexpr double kConcentrated = 0.8;   // mass of the modes together, before they may stand for the belief
constexpr std::size_t kMost = 6;
constexpr double kGross = 0.5;         // [m] more than maps are wrong and things are moved
constexpr double kHeadingError = 2.5;  // [deg]
constexpr double kFewBeams = 3.0;      // so many more that fit the best place only, and
constexpr double kShareOfBeams = 0.03;
constexpr double kApart = 1.5;  // [m] evidence of one spot errs together
constexpr int kSpots = 4;
constexpr double kEnough = 2.0;     // sweeps that speak against a place
constexpr double kToldApart = 6.0;  // [nat] of other sensors

bool is_same_place(const BeliefMode& a, const BeliefMode& b) {
  return distance(a.map_from_robot.position(), b.map_from_robot.position()) < kFar &&
         std::abs((a.map_from_robot.theta - b.map_from_robot.theta).degrees()) < kTurned;
}

enum class Fit { good, gross, unknown };

Fit fit_of(const sensor_models::RayCaster& caster, const sensor_models::SweepBeam& beam, const Pose2& pose,
           double max_range) {
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const double off : {-kHeadingError, 0.0, kHeadingError}) {
    const Point2 direction = unit(pose.theta + Angle::radians(beam.bearing) + Angle::degrees(off));
    const auto expected = caster.cast(pose.position(), direction, max_range, kGross);
    if (!expected) return Fit::unknown;
    least = std::min(least, *expected);
    most = std::max(most, *expected);
  }
  const double range = beam.no_return ? max_range : beam.range;
  return range > most + kGross || range < least - kGross ? Fit::gross : Fit::good;
}

}  // namespace

GrossDifference gross_difference(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep,
                                 const Pose2& first, const Pose2& second, double max_range) {
  constexpr std::size_t kBeams = 120;
  GrossDifference result;
  const std::size_t stride = std::max<std::size_t>(1, sweep.beams.size() / kBeams);
  for (std::size_t i = 0; i < sweep.beams.size(); i += stride) {
    const Fit of_first = fit_of(caster, sweep.beams[i], first, max_range);
    const Fit of_second = fit_of(caster, sweep.beams[i], second, max_range);
    ++result.beams;
    // What the map does not know at one place is no wall to be met there: readings that end on one speak for the other.
    result.first_only += of_first == Fit::good && of_second != Fit::good ? 1 : 0;
    result.second_only += of_second == Fit::good && of_first != Fit::good ? 1 : 0;
  }
  return result;
}

std::optional<std::vector<BeliefMode>> Rivals::update(const BeliefSummary& summary,
                                                      const sensor_models::RangeSweep& sweep,
                                                      const Pose2& before_from_after,
                                                      const sensor_models::RayCaster& caster, double max_range) {
  follow(summary, sweep, before_from_after, caster, max_range);
  return restored(summary);
}

void Rivals::follow(const BeliefSummary& summary, const sensor_models::RangeSweep& sweep,
                    const Pose2& before_from_after, const sensor_models::RayCaster& caster, double max_range) {
  if (summary.modes.empty()) return;
  way_ += norm(before_from_after.position());
  for (Place& place : places_) {
    place.mode.map_from_robot = place.mode.map_from_robot * before_from_after;
    place.mode.mass = 0.0;
  }
  const BeliefMode& best = summary.modes.front();
  for (const BeliefMode& mode : summary.modes) take_in(mode, kWorthMention * best.mass);
  std::erase_if(places_, [&](Place& place) {
    if (is_same_place(place.mode, best))
      return distance(place.mode.map_from_robot.position(), best.map_from_robot.position()) > 0.0;
    const GrossDifference seen =
        gross_difference(caster, sweep, best.map_from_robot, place.mode.map_from_robot, max_range);
    const double more = seen.first_only - seen.second_only;
    const bool speaks_against = more > std::max(kFewBeams, kShareOfBeams * seen.beams);
    place.against = speaks_against ? place.against + 1.0 : std::max(0.0, place.against - 0.5);
    return place.against >= kEnough;
  });
}

void Rivals::take_in(const BeliefMode& mode, double least_mass) {
  const auto known =
      std::find_if(places_.begin(), places_.end(), [&](const Place& place) { return is_same_place(place.mode, mode); });
  if (known == places_.end()) {
    if (mode.mass >= least_mass && places_.size() < kMost) places_.push_back({mode, 0.0, 0.0, 0, way_});
  } else if (mode.mass > known->mode.mass) {
    known->mode = mode;
  }
}

void Rivals::hear(const BeliefSummary& summary, const ObservationModels& others, double weight) {
  if (summary.modes.empty()) return;
  const double of_best = others.cost(summary.modes.front().map_from_robot);
  for (Place& place : places_) {
    const double more = weight * (others.cost(place.mode.map_from_robot) - of_best);
    place.others_against = std::clamp(place.others_against + more, -kToldApart, 2.0 * kToldApart);
  }
}

std::optional<std::vector<BeliefMode>> Rivals::restored(const BeliefSummary& summary) {
  if (summary.modes.empty()) return std::nullopt;
  double mass = 0.0;
  for (const BeliefMode& mode : summary.modes) mass += mode.mass;
  if (mass < kConcentrated) return std::nullopt;
  const BeliefMode& best = summary.modes.front();
  const double fair = kFairShare * best.mass;
  const auto is_missing = [&](const Place& place) {
    return !is_same_place(place.mode, best) && place.mode.mass < 0.5 * fair && place.others_against < kToldApart;
  };
  std::erase_if(places_, [&](Place& place) {
    if (is_same_place(place.mode, best)) place.outweighed = 0;
    if (!is_missing(place) || way_ - place.outweighed_at < kApart) return false;
    place.outweighed_at = way_;
    return ++place.outweighed >= kSpots;
  });
  if (std::none_of(places_.begin(), places_.end(), is_missing)) return std::nullopt;
  std::vector<BeliefMode> modes{best};
  double sum = best.mass;
  for (const Place& place : places_) {
    if (is_same_place(place.mode, best)) continue;
    modes.push_back(place.mode);
    if (place.others_against < kToldApart) modes.back().mass = std::max(place.mode.mass, fair);
    sum += modes.back().mass;
  }
  for (BeliefMode& mode : modes) mode.mass /= sum;
  return modes;
}

}  // namespace docent::localization
