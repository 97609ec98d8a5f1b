#include "docent/people/body_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace docent {
namespace {

constexpr std::array<double, 3> kPeople{0.165, 0.22, 0.27};  // [m] radii
constexpr std::array<double, 2> kThings{0.42, 0.65};         // [m] columns, globes, round tables
constexpr double kNoise = 0.045;                             // [m] of the rim: sensor and clothes
constexpr double kFarOff = 0.15;                             // [m] a point farther off the rim costs no more
constexpr double kPrice = 5.0;                               // [nat] of a body
constexpr double kKnownPrice = 3.0;                          // [nat] of a body where one is expected
constexpr double kKnownWithin = 0.35;                        // [m]
constexpr double kTooClose = 0.34;                           // [m] between centres
constexpr double kOverlapPrice = 12.0;                       // [nat]
constexpr double kCounts = 12.0;  // points that count fully on a body: neighbouring beams err together
constexpr double kThingWidth = 0.7;
constexpr std::size_t kThingPoints = 6;
constexpr int kIterations = 7;
constexpr std::size_t kMostBodies = 8;  // in one run of points
constexpr double kSettled = 0.001;      // [m] centres that move no farther stay

double rim_cost(double off, double noise) {
  const double bounded = std::min(std::abs(off), kFarOff);
  return bounded * bounded / (2.0 * noise * noise);
}

/// Whose rim is nearest to a point, the first of them.
class NearestRim {
 public:
  NearestRim(std::span<const Point2> centres, double radius) : centres_{centres}, radius_{radius} {}
  struct Found {
    std::size_t owner = 0;
    double way = 0.0;  ///< [m] to its centre
  };
  /// `guess`: to be asked first.
  [[nodiscard]] Found at(Point2 point, std::size_t guess) const {
    Found found{guess, distance(point, centres_[guess])};
    if (centres_.size() == 1) return found;
    double least = std::abs(found.way - radius_);
    for (std::size_t c = 0; c < centres_.size(); ++c) {
      if (c == guess) continue;
      const Point2 off = point - centres_[c];
      const double squared = dot(off, off);
      if (is_farther_off(squared, least)) continue;
      const double way = std::sqrt(squared);
      const double off_rim = std::abs(way - radius_);
      if (off_rim < least || (off_rim == least && c < found.owner)) {
        least = off_rim;
        found = {c, way};
      }
    }
    return found;
  }

 private:
  /// Most are: no root is needed for them.
  [[nodiscard]] bool is_farther_off(double squared, double least) const {
    constexpr double kRounding = 1e-9;
    const double outer = radius_ + least;
    const double inner = radius_ - least;
    return squared > (1.0 + kRounding) * outer * outer || (inner > 0.0 && squared < (1.0 - kRounding) * inner * inner);
  }
  std::span<const Point2> centres_;
  double radius_;
};

/// Moves the centres to the points; returns the disc of each point.
std::vector<std::size_t> settle(std::span<const Point2> points, double radius, std::vector<Point2>& centres) {
  std::vector<std::size_t> owner(points.size(), 0);
  for (int i = 0; i < kIterations; ++i) {
    const NearestRim nearest{centres, radius};
    std::array<Point2, kMostBodies> sums{};
    std::array<int, kMostBodies> counts{};
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto [disc, way] = nearest.at(points[p], owner[p]);
      owner[p] = disc;
      const Point2 inward = centres[disc] - points[p];
      const Point2 middle = way > 1e-6 ? points[p] + (radius / way) * inward : points[p];
      sums[disc] = sums[disc] + middle;
      ++counts[disc];
    }
    double moved = 0.0;
    for (std::size_t c = 0; c < centres.size(); ++c) {
      if (counts[c] == 0) continue;
      const Point2 next = (1.0 / counts[c]) * sums[c];
      moved = std::max(moved, distance(centres[c], next));
      centres[c] = next;
    }
    if (moved < kSettled) break;
  }
  return owner;
}

bool is_known(Point2 centre, std::span<const Point2> known) {
  return std::any_of(known.begin(), known.end(),
                     [centre](Point2 place) { return distance(place, centre) < kKnownWithin; });
}

BodyFit judged(std::span<const Point2> points, double radius, std::vector<Point2> centres,
               std::span<const Point2> known) {
  const auto owner = settle(points, radius, centres);
  BodyFit fit;
  std::array<double, kMostBodies> costs{};
  fit.bodies.reserve(centres.size());
  for (const Point2 centre : centres) fit.bodies.push_back({centre, radius, 0});
  for (std::size_t p = 0; p < points.size(); ++p) {
    costs[owner[p]] += rim_cost(distance(points[p], centres[owner[p]]) - radius, kNoise);
    ++fit.bodies[owner[p]].points;
  }
  for (std::size_t c = 0; c < centres.size(); ++c) {
    fit.cost += is_known(centres[c], known) ? kKnownPrice : kPrice;
    fit.misfit += costs[c];
    fit.cost += costs[c] * std::min(1.0, kCounts / std::max(1, fit.bodies[c].points));
    for (std::size_t other = 0; other < c; ++other)
      if (distance(centres[c], centres[other]) < kTooClose) fit.cost += kOverlapPrice;
  }
  return fit;
}

std::vector<Point2> spread_evenly(std::span<const Point2> points, Point2 sensor, std::size_t count, double radius) {
  std::vector<Point2> centres;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>((static_cast<double>(i) + 0.5) / static_cast<double>(count) *
                                             static_cast<double>(points.size()));
    const Point2 point = points[std::min(at, points.size() - 1)];
    centres.push_back(point + radius * unit(direction(sensor, point)));
  }
  return centres;
}

double extent_of(std::span<const Point2> points) {
  double extent = 0.0;
  for (const Point2 point : points) extent = std::max(extent, distance(points.front(), point));
  return std::max(extent, distance(points.front(), points.back()));
}

/// Misfit of one straight face: the line of least squares.
double face_misfit(std::span<const Point2> points) {
  Point2 mean;
  for (const Point2 point : points) mean = mean + point;
  mean = (1.0 / static_cast<double>(points.size())) * mean;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (const Point2 point : points) {
    const Point2 off = point - mean;
    xx += off.x * off.x;
    yy += off.y * off.y;
    xy += off.x * off.y;
  }
  const Point2 along = unit(Angle::radians(0.5 * std::atan2(2.0 * xy, xx - yy)));
  double cost = 0.0;
  for (const Point2 point : points) cost += rim_cost(cross(along, point - mean), kNoise);
  return cost;
}

/// Misfit of two faces that meet at a corner.
double corner_misfit(std::span<const Point2> points) {
  constexpr std::size_t kFace = 3;  // points
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t corner = kFace; corner + kFace <= points.size(); ++corner)
    least = std::min(least, face_misfit(points.first(corner)) + face_misfit(points.subspan(corner)));
  return least;
}

}  // namespace

BodyFit fit_bodies(std::span<const Point2> points, Point2 sensor, std::span<const Point2> known) {
  const double extent = extent_of(points);
  const auto most = static_cast<std::size_t>(std::clamp(std::ceil(extent / 0.36), 1.0, kMostBodies * 1.0));
  const auto fewest = static_cast<std::size_t>(std::clamp(std::floor(extent / 0.8), 1.0, kMostBodies * 1.0));
  std::vector<Point2> expected;  // of the known: those whose near side is among the points
  for (const Point2 place : known) {
    if (std::any_of(points.begin(), points.end(), [&](Point2 point) { return distance(point, place) < 0.4; }))
      expected.push_back(place);
  }
  BodyFit best;
  best.cost = std::numeric_limits<double>::infinity();
  const auto offer = [&](BodyFit fit) {
    std::erase_if(fit.bodies, [](const Body& body) { return body.points == 0; });
    if (fit.cost < best.cost) best = std::move(fit);
  };
  const double least_price = known.empty() ? kPrice : kKnownPrice;
  for (const double radius : kPeople) {
    for (std::size_t count = fewest; count <= std::max(fewest, most); ++count) {
      if (least_price * static_cast<double>(count) >= best.cost) break;  // even a perfect fit would cost more
      offer(judged(points, radius, spread_evenly(points, sensor, count, radius), known));
    }
    if (!expected.empty() && expected.size() <= kMostBodies) offer(judged(points, radius, expected, known));
  }
  if (extent < kThingWidth || points.size() < kThingPoints) return best;
  // As many points count for a thing as for the people instead of whom it would stand there.
  const auto count = static_cast<double>(best.bodies.size());
  const double weight = std::min(1.0, kCounts * count / static_cast<double>(points.size()));
  double thing = std::min(weight * face_misfit(points) + kPrice, weight * corner_misfit(points) + 2.0 * kPrice);
  for (const double radius : kThings) {
    const BodyFit column = judged(points, radius, spread_evenly(points, sensor, 1, radius), {});
    thing = std::min(thing, weight * column.misfit + kPrice);
  }
  best.thing_gain = weight * best.misfit + kPrice * count - thing;
  return best;
}

}  // namespace docent
