#include "docent/localization/beam_choice/person_shapes.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "docent/localization/beam_choice/straight_walls.h"

namespace docent::localization {
namespace {

constexpr double kReach = 9.5;             // [m] farther off too few beams end on a person
constexpr double kFace = 0.7;              // [m] a straight face so long is a thing, and
constexpr double kSlim = 0.7;              // [m] so wide, at most, is a person
constexpr double kBehind = 0.1;            // [m] that what follows at an edge is nearer or farther off
constexpr double kCusp = 0.05;             // [m] between two bodies that touch, behind their fronts
constexpr double kRound = 2.0;             // [1/m] curvature half way between a wall's and a body's
constexpr double kNoise = 0.025;           // [m] of a reading
constexpr std::size_t kFew = 3;            // beams, fewer may be of a wall that is seen from its side
constexpr std::size_t kFewestOfShape = 5;  // beams, fewer show no curvature

/// Two beams on one surface end nearer to each other than this: the step at the rim of a body, and the beams' distance.
double neighbour_gap(double range) { return 0.10 + 0.05 * range; }

/// What follows beside the outermost beam of a piece.
enum class Edge {
  free,      ///< something farther off: the piece stands before it
  hidden,    ///< something nearer: the piece may go on behind it
  attached,  ///< the same surface
};

/// Neighbouring beams on one surface.
struct Piece {
  std::span<const Point2> points;
  std::span<std::uint8_t> marks;
  Edge left = Edge::free;
  Edge right = Edge::free;
};

/// Curvature [1/m] towards the sensor, by least squares over the chord, and its standard deviation.
struct Curvature {
  double value = 0.0;
  double deviation = 0.0;
};

Curvature curvature_of(std::span<const Point2> points) {
  const Point2 chord = points.back() - points.front();
  const double length = std::max(norm(chord), 1e-6);
  const Point2 along = (1.0 / length) * chord;
  const double side = cross(along, Point2{} - points.front()) > 0.0 ? 1.0 : -1.0;  // of the sensor
  // y = a + b x + c x^2 / 2 by powers up to the fourth, about the mean of x.
  const auto n = static_cast<double>(points.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (const Point2 point : points) {
    mean_x += dot(along, point - points.front()) / n;
    mean_y += cross(along, point - points.front()) / n;
  }
  double xx = 0.0, xxx = 0.0, xy = 0.0;
  for (const Point2 point : points) {
    const double x = dot(along, point - points.front()) - mean_x;
    xx += x * x, xxx += x * x * x, xy += x * (cross(along, point - points.front()) - mean_y);
  }
  double qq = 0.0, qy = 0.0;  // q: x^2 without what a line explains of it
  for (const Point2 point : points) {
    const double x = dot(along, point - points.front()) - mean_x;
    const double q = x * x - xx / n - x * xxx / std::max(xx, 1e-9);
    qq += q * q, qy += q * (cross(along, point - points.front()) - mean_y);
  }
  const double scale = 2.0 / std::max(qq, 1e-12);
  return {-side * scale * qy, 2.0 * kNoise / std::sqrt(std::max(qq, 1e-12))};
}

double extent_of(std::span<const Point2> points) {
  double extent = 0.0;
  for (const Point2 point : points)
    extent = std::max({extent, distance(points.front(), point), distance(points.back(), point)});
  return extent;
}

/// A piece no wider than a person.
bool is_person(const Piece& piece) {
  constexpr double kNotFlat = 1.5;  // deviations: what stands alone is a person unless it is flat, and
  constexpr double kNoWall = 1.0;   // what may go on is none unless it is round
  const bool is_free = piece.left == Edge::free || piece.right == Edge::free;
  const bool is_attached = piece.left == Edge::attached || piece.right == Edge::attached;
  const bool stands_alone = is_free && !is_attached;
  if (piece.points.size() < kFew) return piece.left == Edge::free && piece.right == Edge::free;
  if (piece.points.size() < kFewestOfShape) return stands_alone;
  const Curvature curvature = curvature_of(piece.points);
  if (stands_alone) return curvature.value + kNotFlat * curvature.deviation > kRound;
  return curvature.value - kNoWall * curvature.deviation > kRound;
}

/// The point farthest behind the chord, where two bodies that touch meet; 0: none. Round a corner of more than a right
/// angle, as people stand about the robot, it is the one that is farthest off.
std::size_t cusp_of(std::span<const Point2> points) {
  const Point2 chord = points.back() - points.front();
  const bool is_wide = dot(points.front(), points.back()) < 0.0;
  const double side = cross(chord, Point2{} - points.front()) > 0.0 ? -1.0 : 1.0;
  const double length = std::max(norm(chord), 1e-6);
  std::size_t cusp = 0;
  double deepest = is_wide ? 0.0 : kCusp;
  for (std::size_t i = 2; i + 2 < points.size(); ++i) {
    const double depth = is_wide ? norm(points[i]) : side * cross(chord, points[i] - points.front()) / length;
    if (depth <= deepest) continue;
    deepest = depth;
    cusp = i;
  }
  return cusp;
}

/// Marks the people of a piece, parting it where bodies touch.
void mark(const Piece& piece) {
  if (extent_of(piece.points) <= kSlim) {
    if (is_person(piece)) std::fill(piece.marks.begin(), piece.marks.end(), std::uint8_t{1});
    return;
  }
  const std::size_t cusp = cusp_of(piece.points);
  if (cusp == 0) return;
  mark({piece.points.first(cusp), piece.marks.first(cusp), piece.left, Edge::attached});
  mark({piece.points.subspan(cusp), piece.marks.subspan(cusp), Edge::attached, piece.right});
}

/// The beams of a sweep as a closed round.
class Round {
 public:
  explicit Round(const sensor_models::RangeSweep& sweep)
      : beams_{sweep.beams}, is_wall_{on_straight_walls(sweep, kFace)} {}

  [[nodiscard]] std::size_t size() const { return beams_.size(); }
  [[nodiscard]] const sensor_models::SweepBeam& beam(std::size_t i) const { return beams_[i % size()]; }
  [[nodiscard]] bool may_be_person(std::size_t i) const {
    return !beam(i).no_return && beam(i).range <= kReach && is_wall_[i % size()] == 0;
  }
  /// Whether a beam and the next one end on one surface.
  [[nodiscard]] bool goes_on(std::size_t i) const {
    const sensor_models::SweepBeam& here = beam(i);
    const sensor_models::SweepBeam& next = beam(i + 1);
    return !here.no_return && !next.no_return &&
           distance(sensor_models::endpoint(here), sensor_models::endpoint(next)) <=
               neighbour_gap(std::min(here.range, next.range));
  }
  [[nodiscard]] bool is_one_piece(std::size_t i) const {
    return may_be_person(i) && may_be_person(i + 1) && goes_on(i);
  }
  [[nodiscard]] Edge edge(std::size_t here, std::size_t beside) const {
    if (beam(beside).no_return) return Edge::free;
    const double behind = beam(beside).range - beam(here).range;
    return behind > kBehind ? Edge::free : behind < -kBehind ? Edge::hidden : Edge::attached;
  }

 private:
  std::span<const sensor_models::SweepBeam> beams_;
  std::vector<std::uint8_t> is_wall_;
};

}  // namespace

std::vector<std::uint8_t> on_person_shapes(const sensor_models::RangeSweep& sweep) {
  const Round round{sweep};
  const std::size_t size = round.size();
  std::vector<std::uint8_t> is_person(size, 0);
  std::size_t start = 0;  // between two pieces
  while (start < size && round.is_one_piece(start)) ++start;
  std::vector<Point2> points;
  std::vector<std::uint8_t> marks;
  for (std::size_t begin = start + 1; begin <= start + size;) {
    std::size_t last = begin;
    while (last < start + size && round.is_one_piece(last)) ++last;
    if (round.may_be_person(begin)) {
      points.clear();
      for (std::size_t i = begin; i <= last; ++i) points.push_back(sensor_models::endpoint(round.beam(i)));
      marks.assign(points.size(), 0);
      mark({points, marks, round.edge(begin, begin + size - 1), round.edge(last, last + 1)});
      for (std::size_t i = 0; i < marks.size(); ++i) is_person[(begin + i) % size] = marks[i];
    }
    begin = last + 1;
  }
  return is_person;
}

sensor_models::RangeSweep without(const sensor_models::RangeSweep& sweep, std::span<const std::uint8_t> marks) {
  sensor_models::RangeSweep rest;
  for (std::size_t i = 0; i < sweep.beams.size(); ++i)
    if (marks[i] == 0) rest.beams.push_back(sweep.beams[i]);
  return rest;
}

}  // namespace docent::localization
