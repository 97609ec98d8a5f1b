#include "docent/localization/sonar/tracker/echo_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::localization {
namespace {

constexpr float kFarthest = 100.0F;  // [m], of an empty map
constexpr double kNear = 0.3;        // [m] from a wall its direction is asked, up to
constexpr double kFar = 0.8;         // [m]
constexpr double kAligned = 8.0 * kDegree;

/// Modulo a right angle, -45..45 degrees.
double off_right(double heading, double from) { return std::remainder(heading - from, kRightAngle); }

}  // namespace

EchoMap::EchoMap(const OccupancyGrid& map) : frame_{map.frame} {
  std::vector<bool> occupied(frame_.size());
  for (std::size_t i = 0; i < occupied.size(); ++i) occupied[i] = map.cells[i] >= 65;
  distances_ = distance_transform(frame_, occupied);
  for (float& value : distances_) value = std::min(value, kFarthest);
  main_direction_ = find_main_direction(map);
}

double EchoMap::distance_at(Point2 in_map) const {
  const double x =
      std::clamp((in_map.x - frame_.origin.x) / frame_.resolution - 0.5, 0.0, static_cast<double>(frame_.columns - 1));
  const double y =
      std::clamp((in_map.y - frame_.origin.y) / frame_.resolution - 0.5, 0.0, static_cast<double>(frame_.rows - 1));
  const int column = std::min(static_cast<int>(x), std::max(0, frame_.columns - 2));
  const int row = std::min(static_cast<int>(y), std::max(0, frame_.rows - 2));
  const double u = x - column;
  const double v = y - row;
  const std::size_t first = frame_.index({column, row});
  const std::size_t right = frame_.columns > 1 ? 1 : 0;
  const std::size_t up = frame_.rows > 1 ? static_cast<std::size_t>(frame_.columns) : 0;
  const auto at = [&](std::size_t i) { return static_cast<double>(distances_[i]); };
  return (1.0 - v) * ((1.0 - u) * at(first) + u * at(first + right)) +
         v * ((1.0 - u) * at(first + up) + u * at(first + up + right));
}

Point2 EchoMap::away_at(Point2 in_map) const {
  const double step = 2.0 * frame_.resolution;  // over a step of the raster
  const Point2 slope{distance_at(in_map + Point2{step, 0.0}) - distance_at(in_map - Point2{step, 0.0}),
                     distance_at(in_map + Point2{0.0, step}) - distance_at(in_map - Point2{0.0, step})};
  const double length = norm(slope);
  return length > 1e-9 ? (1.0 / length) * slope : Point2{};
}

double EchoMap::ray(Point2 from, Point2 direction, double max_range) const {
  const double touch = 0.5 * frame_.resolution;
  const double creep = 0.25 * frame_.resolution;
  double range = 0.0;
  double last = std::numeric_limits<double>::infinity();
  while (range < max_range) {
    const double room = distance_at(from + range * direction);
    // A cell's distance is that of its centre, so surfaces lie at 0; past the least distance the ray is inside.
    if (room < touch && room >= last) return range;
    if (room < 0.1 * touch) return range;
    last = room < touch ? room : std::numeric_limits<double>::infinity();
    range += std::max(room < touch ? creep : room - 0.5 * touch, creep);
  }
  return max_range;
}

std::optional<ExpectedEcho> EchoMap::expect(const Pose2& map_from_sonar, double half_cone, int rays,
                                            double max_range) const {
  const Point2 from = map_from_sonar.position();
  if (distance_at(from) < frame_.resolution) return std::nullopt;
  double nearest = max_range;
  Point2 direction{};
  for (int i = 0; i < rays; ++i) {
    const double share = rays > 1 ? 2.0 * i / (rays - 1) - 1.0 : 0.0;
    const Point2 sound = unit(map_from_sonar.theta + Angle::radians(share * half_cone));
    const double range = ray(from, sound, nearest);
    if (range >= nearest) continue;
    nearest = range;
    direction = sound;
  }
  if (nearest >= max_range) return std::nullopt;
  const double back = std::min(nearest, 3.0 * frame_.resolution);
  const Point2 away = away_at(from + (nearest - back) * direction);
  return ExpectedEcho{nearest, std::acos(std::clamp(-dot(away, direction), 0.0, 1.0))};
}

std::optional<EchoMap::MainDirection> EchoMap::find_main_direction(const OccupancyGrid& map) const {
  const std::vector<double> headings = normals(map);
  if (headings.empty()) return std::nullopt;
  const std::vector<Point2> surface = surface_cells(map);
  // First with wide lines, in which half a degree does not matter.
  const double near = sharpest(surface, 0.0, 4.7 * frame_.resolution, 90, 0.5 * kDegree);
  const double heading = sharpest(surface, near, 1.9 * frame_.resolution, 10, 0.1 * kDegree);
  const auto aligned = std::count_if(headings.begin(), headings.end(),
                                     [&](double normal) { return std::abs(off_right(normal, heading)) < kAligned; });
  return MainDirection{Angle::radians(off_right(heading, 0.0)),
                       static_cast<double>(aligned) / static_cast<double>(headings.size())};
}

std::vector<double> EchoMap::normals(const OccupancyGrid& map) const {
  std::vector<double> headings;
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const CellIndex cell{column, row};
      const double room = static_cast<double>(distances_[frame_.index(cell)]);
      if (!map.is_free(cell) || room < kNear || room > kFar) continue;
      const Point2 away = away_at(frame_.centre(cell));
      if (away == Point2{}) continue;
      headings.push_back(std::atan2(away.y, away.x));
    }
  }
  return headings;
}

std::vector<Point2> EchoMap::surface_cells(const OccupancyGrid& map) const {
  std::vector<Point2> result;
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const bool faces_room = map.is_free({column - 1, row}) || map.is_free({column + 1, row}) ||
                              map.is_free({column, row - 1}) || map.is_free({column, row + 1});
      if (faces_room && map.is_occupied({column, row})) result.push_back(frame_.centre({column, row}));
    }
  }
  return result;
}

double EchoMap::sharpest(const std::vector<Point2>& surface, double round, double line, int steps, double step) const {
  double heading = round;
  double best = 0.0;
  for (int i = -steps; i <= steps; ++i) {
    const double sharp = sharpness(surface, round + i * step, line);
    if (sharp <= best) continue;
    best = sharp;
    heading = round + i * step;
  }
  return heading;
}

double EchoMap::sharpness(const std::vector<Point2>& surface, double heading, double line) const {
  // Seen along its walls, a building is a few sharp lines.
  const Point2 along{std::cos(heading), std::sin(heading)};
  const Point2 across{-along.y, along.x};
  const double reach = frame_.resolution * std::hypot(frame_.columns, frame_.rows);
  const auto bins = static_cast<std::size_t>(2.0 * reach / line) + 2;
  double sum = 0.0;
  for (const Point2 axis : {along, across}) {
    std::vector<double> histogram(bins, 0.0);
    for (const Point2 point : surface) {
      const double at = (dot(axis, point - frame_.origin) + reach) / line;
      const auto bin = static_cast<std::size_t>(at);
      histogram[bin] += 1.0 - (at - static_cast<double>(bin));
      histogram[bin + 1] += at - static_cast<double>(bin);
    }
    for (const double count : histogram) sum += count * count;
  }
  return sum;
}

}  // namespace docent::localization
