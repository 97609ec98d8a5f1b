#include "docent/planning/exploration/tell_apart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent::planning {
namespace {

constexpr double kMapError = 0.3;   // [m] a smaller difference is none
constexpr double kNoise = 0.4;      // [m] of a reading against an imagined one: the pose within its mode above all
constexpr double kMostABeam = 2.0;  // [nat] that one beam can tell: it may have met a person
constexpr double kVisible = 8.0;    // [m] people hide what is so far away in 63 % of all cases
constexpr double kTogether = 0.7;   // beams err together; but the drive brings many readings
constexpr double kExcluded = 20.0;  // [nat] against a hypothesis under which the robot would stand in a wall
constexpr std::array<double, 11> kWays{0.75, 1.25, 2.0, 2.75, 3.5, 4.5, 6.0, 8.0, 10.0, 12.0, 15.0};  // [m]

double entropy_of(std::span<const double> masses) {
  double sum = 0.0;
  for (const double mass : masses) sum += mass;
  double result = 0.0;
  for (const double mass : masses) {
    const double p = mass / sum;
    if (p > 0.0) result -= p * std::log(p);
  }
  return result;
}

/// Expected log-likelihood ratio [nat] of two readings, the first of which is right.
double separation(const std::vector<double>& truth, const std::vector<double>& other) {
  if (truth.empty() || other.empty()) return truth.empty() == other.empty() ? 0.0 : kExcluded;
  double sum = 0.0;
  for (std::size_t beam = 0; beam < truth.size(); ++beam) {
    const double off = std::max(0.0, std::abs(truth[beam] - other[beam]) - kMapError) / kNoise;
    // The nearer of the two must be visible for the difference to show.
    const double visible = std::exp(-std::min(truth[beam], other[beam]) / kVisible);
    sum += visible * std::min(0.5 * off * off, kMostABeam);
  }
  return kTogether * sum;
}

constexpr double kSameGoal = 2.0;    // [m]
constexpr double kConstancy = 0.15;  // [nat] two goals that promise the same must not take turns

/// A direction from the robot, and how far it may be driven.
struct Leg {
  Angle bearing{};    ///< base frame
  double free = 0.0;  ///< [m]
};

/// The leg that comes farthest in a direction, round what stands in between; nullopt where none comes far.
std::optional<Leg> leg_towards(Angle bearing, std::span<const Leg> legs) {
  constexpr double kAside = 60.0;  // [deg]
  constexpr double kFar = 0.6;     // [m]
  std::optional<Leg> best;
  double farthest = kFar;
  for (const Leg& leg : legs) {
    const Angle aside = leg.bearing - bearing;
    const double progress = std::min(leg.free, 2.5) * std::cos(aside.radians());
    if (std::abs(aside.degrees()) > kAside || progress <= farthest) continue;
    farthest = progress;
    best = leg;
  }
  return best;
}

}  // namespace

Result<void> TellApartParams::validate() const {
  if (!(least_mass >= 0.0 && least_mass <= 1.0)) return fail("tell_apart.least_mass must lie between 0 and 1");
  if (!(least_gain > 0.0 && way_cost >= 0.0)) return fail("tell_apart: least_gain must be > 0 and way_cost >= 0 nat");
  if (!(longest_way >= 0.75 && longest_way <= 10.0))
    return fail("tell_apart.longest_way must lie between 0.75 and 10 m");
  if (!(keep_off >= 0.3)) return fail("tell_apart.keep_off must be at least 0.3 m");
  return {};
}

double clearance_of_cone(std::span<const double> clearances, int index) {
  const int count = static_cast<int>(clearances.size());
  const int spread = count * 20 / 360;
  double least = clearances[static_cast<std::size_t>(index)];
  for (int k = -spread; k <= spread; ++k) {
    least = std::min(least, clearances[static_cast<std::size_t>((index + k + count) % count)]);
  }
  return least;
}

TellApart::TellApart(const OccupancyGrid& map, double robot_radius, const TellApartParams& params)
    : caster_{map}, radius_{robot_radius}, params_{params} {}

std::vector<double> TellApart::imagined(const PossiblePose& hypothesis, Point2 in_base, double max_range) const {
  const Point2 from = hypothesis.map_from_robot * in_base;
  if (!(caster_.clearance(from) >= 0.8F * static_cast<float>(radius_)) || caster_.clearance(from) > 1e6F) return {};
  std::vector<double> ranges;
  ranges.reserve(kBeams);
  for (int beam = 0; beam < kBeams; ++beam) {
    const Angle bearing = hypothesis.map_from_robot.theta + Angle::degrees(360.0 * beam / kBeams);
    ranges.push_back(caster_.cast(from, unit(bearing), max_range, max_range).value_or(max_range));
  }
  return ranges;
}

bool TellApart::may_stand(std::span<const PossiblePose> hypotheses, Point2 in_base) const {
  return std::all_of(hypotheses.begin(), hypotheses.end(), [&](const PossiblePose& hypothesis) {
    const double clearance = static_cast<double>(caster_.clearance(hypothesis.map_from_robot * in_base));
    return clearance > radius_ + 0.2 && std::isfinite(clearance);
  });
}

double TellApart::expected_entropy(std::span<const PossiblePose> hypotheses, Point2 in_base, double max_range) const {
  std::vector<std::vector<double>> readings;
  for (const auto& hypothesis : hypotheses) readings.push_back(imagined(hypothesis, in_base, max_range));
  double total = 0.0;
  double expected = 0.0;
  std::vector<double> left(hypotheses.size());
  for (std::size_t truth = 0; truth < hypotheses.size(); ++truth) {
    for (std::size_t other = 0; other < hypotheses.size(); ++other) {
      left[other] = hypotheses[other].mass * std::exp(-separation(readings[truth], readings[other]));
    }
    expected += hypotheses[truth].mass * entropy_of(left);
    total += hypotheses[truth].mass;
  }
  return total > 0.0 ? expected / total : 0.0;
}

std::optional<TellApart::Place> TellApart::best_place(std::span<const PossiblePose> hypotheses,
                                                      std::span<const double> clearances, double max_range,
                                                      std::optional<Point2> last_goal) const {
  hypotheses = hypotheses.first(std::min(hypotheses.size(), kMostHypotheses));
  double mass = 0.0;
  for (const auto& hypothesis : hypotheses) mass += hypothesis.mass;
  if (hypotheses.size() < 2 || mass < params_.least_mass || clearances.empty()) return std::nullopt;

  // What readings from here would tell is on its way already: a drive is worth what it tells beyond that.
  const double here = expected_entropy(hypotheses, {}, max_range);
  std::optional<Place> best;
  double most = 0.0;
  std::array<Leg, kBearings> legs;
  for (int i = 0; i < kBearings; ++i) {
    const int index = i * static_cast<int>(clearances.size()) / kBearings;
    const auto k = static_cast<std::size_t>(i);
    legs[k].bearing = Angle::degrees(-180.0 + 360.0 * index / static_cast<double>(clearances.size()));
    legs[k].free = clearance_of_cone(clearances, index) - params_.keep_off;
  }
  for (const Leg& towards : legs) {
    const auto leg = leg_towards(towards.bearing, legs);
    for (const double way : kWays) {
      const Point2 place = way * unit(towards.bearing);
      const bool is_straight = way <= towards.free;
      if (!is_straight && (!leg || !may_stand(hypotheses, place))) continue;
      const double gain = here - expected_entropy(hypotheses, place, max_range);
      const bool is_kept = last_goal && distance(*last_goal, place) < kSameGoal;
      const double worth = gain - params_.way_cost * way + (is_kept ? kConstancy : 0.0);
      if (gain < params_.least_gain || (best && worth <= most)) continue;
      most = worth;
      const Leg& first = is_straight ? towards : *leg;
      best = Place{std::min({way, first.free, params_.longest_way}) * unit(first.bearing), place, gain};
    }
  }
  return best;
}

}  // namespace docent::planning
