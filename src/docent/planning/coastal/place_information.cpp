#include "docent/planning/coastal/place_information.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace docent::planning {
namespace {

constexpr double kUnknownAllowance = 0.3;  // [m] of a ray that the map may not know
constexpr double kChord = 0.5;             // [m] of a wall by which its direction is told
constexpr double kBend = 0.12;             // [m] that the middle of such a piece may lie off its chord
constexpr double kSteepest = 4.0;          // tangent of the angle of incidence: beyond, a beam grazes
constexpr double kWidest = 0.35;           // [rad] to either side from which a wall's direction is told

Point2 end_of(std::size_t beam, double range, double step) {
  return range * unit(Angle::radians(static_cast<double>(beam) * step));
}

/// t = (dr / dheading) / r of a beam, from the chord between two beams to its sides; nullopt at edges, at grazing
/// incidence, and where nothing is in reach.
std::optional<double> slope(std::span<const float> ranges, std::size_t beam, double reach) {
  const std::size_t beams = ranges.size();
  const double step = 2.0 * std::numbers::pi / static_cast<double>(beams);
  const auto range = static_cast<double>(ranges[beam]);
  if (range >= reach || range <= 0.0) return std::nullopt;
  const double half = std::min(kWidest, kChord / 2.0 / range);
  const auto aside = static_cast<std::size_t>(std::max(1.0, std::ceil(half / step)));
  const std::size_t left = (beam + aside) % beams;
  const std::size_t right = (beam + beams - aside) % beams;
  if (static_cast<double>(ranges[left]) >= reach || static_cast<double>(ranges[right]) >= reach) return std::nullopt;
  const Point2 a = end_of(right, static_cast<double>(ranges[right]), step);
  const Point2 b = end_of(left, static_cast<double>(ranges[left]), step);
  const double length = distance(a, b);
  const Point2 along = (1.0 / length) * (b - a);
  const Point2 ray = end_of(beam, 1.0, step);
  if (std::abs(cross(along, range * ray - a)) > kBend) return std::nullopt;
  const double across = std::abs(cross(along, ray));  // cosine of the angle of incidence
  if (across < 1e-6) return std::nullopt;
  // Along the wall d(end) = r' d + r d' for a turn: r' / r = (along d) / (along d').
  const double t = dot(along, ray) / cross(ray, along);
  if (std::abs(t) > kSteepest) return std::nullopt;
  return t;
}

}  // namespace

Result<void> PlaceInformationParams::validate() const {
  if (!(range > 0.0)) return fail("range must be > 0");
  if (!(blocked >= 0.0 && blocked <= 0.95)) return fail("blocked must be in 0..0.95");
  if (beams < 8 || beams > 720) return fail("beams must be in 8..720");
  if (!(hit_deviation > 0.0)) return fail("hit_deviation must be > 0");
  if (!(map_deviation >= 0.0)) return fail("map_deviation must be >= 0");
  if (!(independent_beams > 0.0)) return fail("independent_beams must be > 0");
  return {};
}

std::array<double, 3> PoseInformation::eigenvalues(double heading_scale) const {
  // Closed form for symmetric 3 x 3 matrices (Smith, Eigenvalues of a symmetric 3 x 3 matrix, 1961).
  const double a = xx;
  const double b = yy;
  const double c = heading_scale * heading_scale * tt;
  const double d = xy;
  const double e = heading_scale * xt;
  const double f = heading_scale * yt;
  const double mean = (a + b + c) / 3.0;
  const double spread =
      (a - mean) * (a - mean) + (b - mean) * (b - mean) + (c - mean) * (c - mean) + 2.0 * (d * d + e * e + f * f);
  const double p = std::sqrt(spread / 6.0);
  if (p <= 1e-12 * std::max(1.0, mean)) return {mean, mean, mean};
  const double aa = (a - mean) / p;
  const double bb = (b - mean) / p;
  const double cc = (c - mean) / p;
  const double dd = d / p;
  const double ee = e / p;
  const double ff = f / p;
  const double half_determinant =
      0.5 * (aa * (bb * cc - ff * ff) - dd * (dd * cc - ff * ee) + ee * (dd * ff - bb * ee));
  const double angle = std::acos(std::clamp(half_determinant, -1.0, 1.0)) / 3.0;
  const double first = mean + 2.0 * p * std::cos(angle);
  const double last = mean + 2.0 * p * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
  return {std::max(0.0, first), std::max(0.0, 3.0 * mean - first - last), std::max(0.0, last)};
}

std::vector<float> ranges_around(const sensor_models::RayCaster& caster, Point2 in_map,
                                 const PlaceInformationParams& params) {
  std::vector<float> ranges(static_cast<std::size_t>(params.beams));
  const double step = 2.0 * std::numbers::pi / params.beams;
  for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
    ranges[beam] = static_cast<float>(
        caster.cast(in_map, end_of(beam, 1.0, step), params.range, kUnknownAllowance).value_or(params.range));
  }
  return ranges;
}

double hiding_rate(std::span<const float> ranges, const PlaceInformationParams& params) {
  if (params.blocked <= 0.0 || ranges.empty()) return 0.0;
  const auto hidden = [&](double rate) {
    double sum = 0.0;
    for (const float range : ranges) sum += 1.0 - std::exp(-rate * static_cast<double>(range));
    return sum / static_cast<double>(ranges.size());
  };
  double low = 0.0;
  double high = 100.0;  // a beam of a centimetre is hidden in 63 % of all cases
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (hidden(middle) < params.blocked ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

PoseInformation scan_information(std::span<const float> ranges, double rate, const PlaceInformationParams& params) {
  PoseInformation information;
  const std::size_t beams = ranges.size();
  const double step = 2.0 * std::numbers::pi / static_cast<double>(beams);
  const double share = params.independent_beams / static_cast<double>(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const auto t = slope(ranges, beam, params.range);
    if (!t) continue;
    const auto range = static_cast<double>(ranges[beam]);
    const double variance =
        params.hit_deviation * params.hit_deviation + params.map_deviation * params.map_deviation * (1.0 + *t * *t);
    const double weight = share * std::exp(-rate * range) / variance;
    const Point2 ray = end_of(beam, 1.0, step);
    const Point2 g{-ray.x - *t * ray.y, -ray.y + *t * ray.x};
    const double turn = range * *t;
    information.xx += weight * g.x * g.x;
    information.xy += weight * g.x * g.y;
    information.yy += weight * g.y * g.y;
    information.xt += weight * g.x * turn;
    information.yt += weight * g.y * turn;
    information.tt += weight * turn * turn;
  }
  return information;
}

InformationMap information_map(const OccupancyGrid& map, const GridFrame& frame, std::span<const float> costs,
                               const PlaceInformationParams& params) {
  const sensor_models::RayCaster caster{map};
  std::vector<float> ranges;  // of the open cells, one after another
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      if (!std::isfinite(costs[frame.index({column, row})])) continue;
      const auto scan = ranges_around(caster, frame.centre({column, row}), params);
      ranges.insert(ranges.end(), scan.begin(), scan.end());
    }
  }
  const double rate = hiding_rate(ranges, params);
  InformationMap result{frame, std::vector<PoseInformation>(frame.size())};
  const auto beams = static_cast<std::size_t>(params.beams);
  std::size_t at = 0;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (!std::isfinite(costs[i])) continue;
    result.places[i] = scan_information(std::span{ranges}.subspan(at, beams), rate, params);
    at += beams;
  }
  return result;
}

}  // namespace docent::planning
