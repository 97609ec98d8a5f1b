#include "docent/localization/belief/place_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>

namespace docent::localization {
namespace {

constexpr double kCell = 0.2;         // [m]
constexpr double kHeadingStep = 3.0;  // [deg]
constexpr int kHeadings = static_cast<int>(360.0 / kHeadingStep);
constexpr double kPlaceSigma = 0.2;  // [m] of a reading's end, half a cell and half a step included
constexpr double kBody = 0.15;       // [m] nearer to a wall no robot stands
constexpr std::size_t kMostOfSearch = 60;
constexpr std::size_t kFewestOfSearch = 20;
constexpr double kApart = 1.0;    // [m]
constexpr double kTurned = 20.0;  // [deg]

std::vector<Point2> ends_of_search(const sensor_models::RangeSweep& sweep, double max_range) {
  std::vector<Point2> all;
  for (const sensor_models::SweepBeam& beam : sweep.beams)
    if (!beam.no_return && beam.range < max_range && beam.range >= 0.3) all.push_back(sensor_models::endpoint(beam));
  const std::size_t step = std::max<std::size_t>(1, (all.size() + kMostOfSearch - 1) / kMostOfSearch);
  std::vector<Point2> some;
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

GridFrame cells_of(const GridFrame& map) {
  GridFrame cells = map;
  cells.resolution = kCell;
  cells.columns = std::max(1, static_cast<int>(std::ceil(map.columns * map.resolution / kCell)));
  cells.rows = std::max(1, static_cast<int>(std::ceil(map.rows * map.resolution / kCell)));
  return cells;
}

}  // namespace

struct PlaceSearch::Readings {
  std::array<std::vector<CellIndex>, kHeadings> arms;  ///< ends seen from the robot, in cells, by heading
  std::size_t count = 0;
};

struct PlaceSearch::Node {
  double bound = 0.0;
  int level = 0;
  CellIndex corner;  ///< lower left
  int heading = 0;
  bool operator<(const Node& other) const {
    if (bound != other.bound) return bound < other.bound;
    return level > other.level;  // leaves first
  }
};

PlaceSearch::PlaceSearch(const sensor_models::RayCaster& caster, const OccupancyGrid& standing)
    : frame_{cells_of(caster.frame())} {
  const auto columns = static_cast<std::size_t>(frame_.columns);
  const auto rows = static_cast<std::size_t>(frame_.rows);
  if (columns * rows > kMostCells) return;
  best_.assign(kLevels, std::vector<std::uint8_t>(columns * rows, 0));
  is_free_.assign(columns * rows, false);
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const CellIndex cell{column, row};
      const double off = static_cast<double>(caster.clearance(frame_.centre(cell))) / kPlaceSigma;
      const double fit = std::isfinite(off) ? std::exp(-0.5 * off * off) : 0.0;
      best_[0][frame_.index(cell)] = static_cast<std::uint8_t>(std::lround(255.0 * fit));
      is_free_[frame_.index(cell)] = caster.clearance(frame_.centre(cell)) > static_cast<float>(kBody) &&
                                     standing.is_free(standing.frame.cell_at(frame_.centre(cell)));
    }
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    const auto& below = best_[level - 1];
    const std::size_t half = std::size_t{1} << (level - 1);
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t up = std::min(row + half, rows - 1) * columns;
        const std::size_t right = std::min(column + half, columns - 1);
        best_[level][row * columns + column] = std::max(
            {below[row * columns + column], below[row * columns + right], below[up + column], below[up + right]});
      }
    }
  }
}

template <std::size_t Count>
std::array<double, Count> PlaceSearch::bounds(const std::array<CellIndex, Count>& corners, int level, int heading,
                                              const Readings& readings) const {
  const std::uint8_t* const best = best_[static_cast<std::size_t>(level)].data();
  const int side = 1 << level;
  std::array<int, Count> sums{};
  for (const CellIndex& arm : readings.arms[static_cast<std::size_t>(heading)]) {
    for (std::size_t i = 0; i < Count; ++i) {
      const int column = corners[i].column + arm.column;
      const int row = corners[i].row + arm.row;
      if (column <= -side || row <= -side || column >= frame_.columns || row >= frame_.rows) continue;
      // What lies partly left of the map: a little more than it reaches, a bound still.
      const auto place = static_cast<std::ptrdiff_t>(std::max(row, 0)) * frame_.columns + std::max(column, 0);
      sums[i] += best[place];
    }
  }
  std::array<double, Count> result{};
  for (std::size_t i = 0; i < Count; ++i)
    result[i] = static_cast<double>(sums[i]) / (255.0 * static_cast<double>(readings.count));
  return result;
}

std::vector<FoundPlace> PlaceSearch::find(const sensor_models::RangeSweep& sweep, const Wanted& wanted) const {
  const std::vector<Point2> seen = ends_of_search(sweep, wanted.max_range);
  if (seen.size() < kFewestOfSearch || best_.empty()) return {};
  Readings readings;
  readings.count = seen.size();
  for (int heading = 0; heading < kHeadings; ++heading) {
    const Pose2 turned{0.0, 0.0, Angle::degrees(heading * kHeadingStep)};
    for (const Point2& end : seen) {
      const Point2 arm = turned * end;
      readings.arms[static_cast<std::size_t>(heading)].push_back(
          {static_cast<int>(std::lround(arm.x / kCell)), static_cast<int>(std::lround(arm.y / kCell))});
    }
  }
  std::priority_queue<Node> open;
  constexpr int kTop = kLevels - 1;
  for (int row = 0; row < frame_.rows; row += 1 << kTop)
    for (int column = 0; column < frame_.columns; column += 1 << kTop)
      for (int heading = 0; heading < kHeadings; ++heading)
        open.push({bounds<1>({{{column, row}}}, kTop, heading, readings).front(), kTop, {column, row}, heading});
  std::size_t work = 0;
  std::vector<FoundPlace> found;
  while (!open.empty() && found.size() < wanted.most && work < wanted.work) {
    const Node node = open.top();
    open.pop();
    if (!found.empty() && node.bound < found.front().fit - wanted.within) break;
    if (node.level == 0) {
      const Point2 at = frame_.centre(node.corner);
      const Pose2 pose{at.x, at.y, Angle::degrees(node.heading * kHeadingStep)};
      const bool is_known = std::any_of(found.begin(), found.end(), [&](const FoundPlace& place) {
        return distance(place.map_from_robot.position(), at) < kApart &&
               std::abs((place.map_from_robot.theta - pose.theta).degrees()) < kTurned;
      });
      if (!is_known) found.push_back({pose, node.bound});
      continue;
    }
    const int half = 1 << (node.level - 1);
    const auto [column, row] = node.corner;
    const std::array<CellIndex, 4> corners{
        {{column, row}, {column + half, row}, {column, row + half}, {column + half, row + half}}};
    const auto values = bounds(corners, node.level - 1, node.heading, readings);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!frame_.holds(corners[i]) || (half == 1 && !is_free_[frame_.index(corners[i])])) continue;
      work += readings.count;
      // Nothing that fits so much worse than what was found is ever looked at.
      if (!found.empty() && values[i] < found.front().fit - wanted.within) continue;
      open.push({values[i], node.level - 1, corners[i], node.heading});
    }
  }
  return found;
}

}  // namespace docent::localization
