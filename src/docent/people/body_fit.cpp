#include "docent/people/body_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace docent::people {
namespace {

constexpr std::array<double, 3> kPeople{0.165, 0.22, 0.27};  // [m] radii
constexpr std::array<double, 2> kThings{0.42, 0.65};         // [m] columns, globes, round tables
constexpr double kNoise = 0.045;                             // [m] of the rim: sensor and clothes
constexpr double kFarOff = 0.15;                             // [m] a point farther off the rim costs no more
constexpr double kPrice = 5.0;                               // [nat] of a body
constexpr double kKnownPrice = 3.0;                          // [nat] of a body where one is expected
constexpr double kKnownWithin = 0.35;                        // [m]
constexpr double kAround = 1.0;         // [m] of the points: more than 0.4, and than a disc and kKnownWithin
constexpr double kTooClose = 0.34;      // [m] between centres
constexpr double kOverlapPrice = 12.0;  // [nat]
constexpr double kCounts = 12.0;        // points that count fully on a body: neighbouring beams err together
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

/// Discs of one radius that explain points, moved to these.
class Discs {
 public:
  explicit Discs(std::span<const Point2> points) : points_{points} {}

  void begin_at(std::span<const Point2> centres) { centres_.assign(centres.begin(), centres.end()); }
  void begin_spread_evenly(Point2 sensor, std::size_t count, double radius) {
    centres_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>((static_cast<double>(i) + 0.5) / static_cast<double>(count) *
                                               static_cast<double>(points_.size()));
      const Point2 point = points_[std::min(at, points_.size() - 1)];
      centres_.push_back(point + radius * unit(direction(sensor, point)));
    }
  }
  /// Moves the centres to the points. The fit has its bodies yet to come.
  [[nodiscard]] BodyFit judged(double radius, std::span<const Point2> known) {
    owner_.assign(points_.size(), 0);
    if (centres_.size() == 1) {
      settle_alone(radius);
    } else {
      settle(radius);
    }
    BodyFit fit;
    std::array<double, kMostBodies> costs{};
    counts_ = {};
    for (std::size_t p = 0; p < points_.size(); ++p) {
      const std::size_t disc = owner_[p];
      costs[disc] += rim_cost(distance(points_[p], centres_[disc]) - radius, kNoise);
      ++counts_[disc];
    }
    for (std::size_t c = 0; c < centres_.size(); ++c) {
      fit.cost += is_known(centres_[c], known) ? kKnownPrice : kPrice;
      fit.misfit += costs[c];
      fit.cost += costs[c] * std::min(1.0, kCounts / std::max(1, counts_[c]));
      for (std::size_t other = 0; other < c; ++other)
        if (distance(centres_[c], centres_[other]) < kTooClose) fit.cost += kOverlapPrice;
    }
    return fit;
  }
  /// Of the last fit: those that have points.
  [[nodiscard]] std::vector<Body> bodies(double radius) const {
    std::vector<Body> bodies;
    for (std::size_t c = 0; c < centres_.size(); ++c)
      if (counts_[c] > 0) bodies.push_back({centres_[c], radius, counts_[c]});
    return bodies;
  }

 private:
  /// Where the middle of a disc would be that has a point on its rim, `way` [m] from its centre now.
  [[nodiscard]] static Point2 middle_for(Point2 point, Point2 centre, double way, double radius) {
    return way > 1e-6 ? point + (radius / way) * (centre - point) : point;
  }
  /// What `settle` does where all points are the one disc's.
  void settle_alone(double radius) {
    Point2& centre = centres_.front();
    for (int i = 0; i < kIterations; ++i) {
      Point2 sum;
      for (const Point2 point : points_) sum = sum + middle_for(point, centre, distance(point, centre), radius);
      const Point2 next = (1.0 / static_cast<double>(points_.size())) * sum;
      const double moved = distance(centre, next);
      centre = next;
      if (moved < kSettled) break;
    }
  }
  void settle(double radius) {
    for (int i = 0; i < kIterations; ++i) {
      const NearestRim nearest{centres_, radius};
      std::array<Point2, kMostBodies> sums{};
      std::array<int, kMostBodies> counts{};
      for (std::size_t p = 0; p < points_.size(); ++p) {
        const auto [disc, way] = nearest.at(points_[p], owner_[p]);
        owner_[p] = disc;
        sums[disc] = sums[disc] + middle_for(points_[p], centres_[disc], way, radius);
        ++counts[disc];
      }
      double moved = 0.0;
      for (std::size_t c = 0; c < centres_.size(); ++c) {
        if (counts[c] == 0) continue;
        const Point2 next = (1.0 / counts[c]) * sums[c];
        moved = std::max(moved, distance(centres_[c], next));
        centres_[c] = next;
      }
      if (moved < kSettled) break;
    }
  }
  [[nodiscard]] static bool is_known(Point2 centre, std::span<const Point2> known) {
    return std::any_of(known.begin(), known.end(),
                       [centre](Point2 place) { return distance(place, centre) < kKnownWithin; });
  }

  std::span<const Point2> points_;
  std::vector<Point2> centres_;
  std::vector<std::size_t> owner_;         ///< [points]
  std::array<int, kMostBodies> counts_{};  ///< points of each disc
};

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
  std::vector<Point2> around;    // of the known: no other is near to a point, or to a disc that has any
  std::vector<Point2> expected;  // of these: those whose near side is among the points
  for (const Point2 place : known) {
    if (distance(points.front(), place) > extent + kAround) continue;
    around.push_back(place);
    if (std::any_of(points.begin(), points.end(), [&](Point2 point) { return distance(point, place) < 0.4; }))
      expected.push_back(place);
  }
  BodyFit best;
  best.cost = std::numeric_limits<double>::infinity();
  Discs discs{points};
  const double least_price = known.empty() ? kPrice : kKnownPrice;
  // Even a perfect fit of so many may cost more.
  const auto may_be_better = [&](std::size_t count) { return least_price * static_cast<double>(count) < best.cost; };
  const auto judge = [&](double radius) {
    BodyFit fit = discs.judged(radius, around);
    if (!(fit.cost < best.cost)) return;
    fit.bodies = discs.bodies(radius);
    best = std::move(fit);
  };
  for (const double radius : kPeople) {
    for (std::size_t count = fewest; count <= std::max(fewest, most) && may_be_better(count); ++count) {
      discs.begin_spread_evenly(sensor, count, radius);
      judge(radius);
    }
    if (expected.empty() || expected.size() > kMostBodies || !may_be_better(expected.size())) continue;
    discs.begin_at(expected);
    judge(radius);
  }
  if (extent < kThingWidth || points.size() < kThingPoints) return best;
  // As many points count for a thing as for the people instead of whom it would stand there.
  const auto count = static_cast<double>(best.bodies.size());
  const double weight = std::min(1.0, kCounts * count / static_cast<double>(points.size()));
  double thing = std::min(weight * face_misfit(points) + kPrice, weight * corner_misfit(points) + 2.0 * kPrice);
  for (const double radius : kThings) {
    discs.begin_spread_evenly(sensor, 1, radius);
    thing = std::min(thing, weight * discs.judged(radius, {}).misfit + kPrice);
  }
  best.thing_gain = weight * best.misfit + kPrice * count - thing;
  return best;
}

}  // namespace docent::people
