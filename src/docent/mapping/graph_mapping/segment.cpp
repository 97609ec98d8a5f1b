#include "docent/mapping/graph_mapping/segment.h"

#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

/// What one scan says of free floor: the cells on the lines to its points, up to a margin before each.
void mark_free(const GridFrame& frame, Point2 from, Point2 to, double margin, std::vector<bool>& free) {
  const double length = distance(from, to) - margin;
  if (length <= 0.0) return;
  const Point2 along = (1.0 / distance(from, to)) * (to - from);
  const double step = 0.7 * frame.resolution;
  for (double d = 0.0; d < length; d += step) {
    const CellIndex cell = frame.cell_at(from + d * along);
    if (frame.holds(cell)) free[frame.index(cell)] = true;
  }
}

double share_on_free_floor(const Segment& seer, std::span<const Point2> points, const Pose2& seer_from_points) {
  if (points.empty()) return 0.0;
  const auto count =
      std::count_if(points.begin(), points.end(), [&](Point2 p) { return seer.is_free(seer_from_points * p); });
  return static_cast<double>(count) / static_cast<double>(points.size());
}

}  // namespace

Segment::Segment(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base, std::size_t first,
                 std::size_t last, const SegmentParams& params, const MatchGridParams& grid)
    : first_{first}, last_{last} {
  const Pose2 middle_from_map = inverse(map_from_base[middle()]);
  std::vector<Point2> places;
  std::vector<double> ranges;
  for (std::size_t i = first; i <= last; ++i) {
    const Pose2 middle_from_scan = middle_from_map * map_from_base[i];
    for (const SurfacePoint& point : scans[i].points) {
      const SurfacePoint seen = transformed(middle_from_scan, point);
      if (norm(seen.at) > params.reach) continue;
      points_.push_back(seen);
      places.push_back(seen.at);
      ranges.push_back(norm(seen.at));
    }
  }
  if (points_.empty()) return;
  const auto most = ranges.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), most, ranges.end());
  radius_ = *most;
  query_ = thinned_points(places, params.query_cell);
  grid_ = std::make_unique<MatchGrid>(places, grid);

  const int cells = static_cast<int>(std::ceil(2.0 * params.reach / params.free_cell));
  free_frame_ = {cells, cells, params.free_cell, {-params.reach, -params.reach}};
  free_.assign(free_frame_.size(), false);
  constexpr double kMargin = 0.3;  // [m]: near what it ends on a beam says little
  for (std::size_t i = first; i <= last; ++i) {
    const Pose2 middle_from_scan = middle_from_map * map_from_base[i];
    for (const SurfacePoint& point : scans[i].points) {
      // The sensor that saw the point is the nearest one: a beam from another would have to pass through the robot.
      Point2 sensor = scans[i].sensors.front();
      for (const Point2 other : scans[i].sensors) {
        if (distance(other, point.at) < distance(sensor, point.at)) sensor = other;
      }
      mark_free(free_frame_, middle_from_scan * sensor, middle_from_scan * point.at, kMargin, free_);
    }
  }
  for (const Point2 p : places) {
    const CellIndex at = free_frame_.cell_at(p);
    const int reach = static_cast<int>(kMargin / params.free_cell);
    for (int row = at.row - reach; row <= at.row + reach; ++row) {
      for (int column = at.column - reach; column <= at.column + reach; ++column) {
        if (free_frame_.holds({column, row})) free_[free_frame_.index({column, row})] = false;
      }
    }
  }
}

bool Segment::is_free(Point2 at) const {
  const CellIndex cell = free_frame_.cell_at(at);
  return free_frame_.holds(cell) && free_[free_frame_.index(cell)];
}

double share_in_conflict(const Segment& older, const Segment& newer, const Pose2& older_from_newer) {
  return std::max(share_on_free_floor(older, newer.query(), older_from_newer),
                  share_on_free_floor(newer, older.query(), inverse(older_from_newer)));
}

}  // namespace docent::mapping
