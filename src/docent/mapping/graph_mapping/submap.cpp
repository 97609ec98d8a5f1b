#include "docent/mapping/graph_mapping/submap.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace docent::mapping {
namespace {

constexpr double kMargin = 0.3;  // [m]: near what it ends on a beam says little

/// [m] before its end a beam may run so near to the surface that it ends on: a beam that grazes a wall runs beside it.
double margin_of(const SurfacePoint& point, Point2 sensor) {
  constexpr double kBeside = 0.15;  // [m], square to the surface
  constexpr double kMost = 2.5;     // [m]
  if (!point.has_normal()) return kMargin;
  const double square = std::abs(dot(point.normal, unit(direction(sensor, point.at))));
  return std::clamp(kBeside / std::max(square, 1e-3), kMargin, kMost);
}

/// Calls `at(cell index)` for the cells on a line, up to a margin before its end.
template <class F>
void for_cells_before(const GridFrame& frame, Point2 from, Point2 to, double margin, F at) {
  const double length = distance(from, to) - margin;
  if (length <= 0.0) return;
  const Point2 along = (1.0 / distance(from, to)) * (to - from);
  const double step = 0.7 * frame.resolution;
  for (double d = 0.0; d < length; d += step) {
    const CellIndex cell = frame.cell_at(from + d * along);
    if (frame.holds(cell)) at(frame.index(cell));
  }
}

/// The sensor that saw the point is the nearest one: a beam from another would have to pass through the robot.
Point2 sensor_of(const MappingScan& scan, Point2 point) {
  return *std::min_element(scan.sensors.begin(), scan.sensors.end(),
                           [&](Point2 a, Point2 b) { return distance(a, point) < distance(b, point); });
}

double share_on_free_floor(const Submap& seer, std::span<const Point2> points, const Pose2& seer_from_points) {
  if (points.empty()) return 0.0;
  const auto count =
      std::count_if(points.begin(), points.end(), [&](Point2 p) { return seer.is_free(seer_from_points * p); });
  return static_cast<double>(count) / static_cast<double>(points.size());
}

}  // namespace

Result<void> SubmapParams::validate() const {
  if (!(way > 0.0)) return fail("way must be > 0 m");
  if (!(turn > 0.0)) return fail("turn must be > 0 rad");
  if (!(scans > 0)) return fail("scans must be > 0");
  if (!(reach > 0.0)) return fail("reach must be > 0 m");
  if (!(query_cell > 0.0)) return fail("query_cell must be > 0 m");
  if (!(still >= 0.0 && still <= 1.0)) return fail("still must be 0..1");
  if (!(free_cell > 0.0)) return fail("free_cell must be > 0 m");
  return {};
}

struct Submap::Seen {
  GridFrame frame;
  std::vector<std::uint16_t> ended;   ///< scans
  std::vector<std::uint16_t> passed;  ///< scans
};

Submap::Seen Submap::look(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base,
                          const SubmapParams& params) const {
  const int cells = static_cast<int>(std::ceil(2.0 * params.reach / params.free_cell));
  Seen seen{{cells, cells, params.free_cell, {-params.reach, -params.reach}}, {}, {}};
  seen.ended.assign(seen.frame.size(), 0);
  seen.passed.assign(seen.frame.size(), 0);
  std::vector<std::size_t> counted(seen.frame.size(), 0);  // the last scan that counted, plus one
  const Pose2 middle_from_map = inverse(map_from_base[middle()]);
  for (std::size_t i = first_; i <= last_; ++i) {
    const Pose2 middle_from_scan = middle_from_map * map_from_base[i];
    const auto count = [&](std::vector<std::uint16_t>& counts, std::size_t cell) {
      if (std::exchange(counted[cell], i + 1) != i + 1) ++counts[cell];
    };
    for (const SurfacePoint& point : scans[i].points) {  // where a scan ends in a cell, its other beams do not count
      const CellIndex cell = seen.frame.cell_at(middle_from_scan * point.at);
      if (seen.frame.holds(cell)) count(seen.ended, seen.frame.index(cell));
    }
    for (const SurfacePoint& point : scans[i].points) {
      const Point2 sensor = sensor_of(scans[i], point.at);
      for_cells_before(seen.frame, middle_from_scan * sensor, middle_from_scan * point.at, margin_of(point, sensor),
                       [&](std::size_t cell) { count(seen.passed, cell); });
    }
  }
  return seen;
}

Submap::Submap(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base, std::size_t first,
               std::size_t last, const SubmapParams& params, const MatchGridParams& grid)
    : first_{first}, last_{last} {
  const Seen seen = look(scans, map_from_base, params);
  const Pose2 middle_from_map = inverse(map_from_base[middle()]);
  std::vector<Point2> places;
  for (std::size_t i = first; i <= last; ++i) {
    const Pose2 middle_from_scan = middle_from_map * map_from_base[i];
    for (const SurfacePoint& point : scans[i].points) {
      const SurfacePoint at = transformed(middle_from_scan, point);
      const CellIndex cell = seen.frame.cell_at(at.at);
      if (norm(at.at) > params.reach || !seen.frame.holds(cell)) continue;
      const double ended = seen.ended[seen.frame.index(cell)];
      if (ended < params.still * (ended + seen.passed[seen.frame.index(cell)])) continue;
      points_.push_back(at);
      places.push_back(at.at);
    }
  }
  if (points_.empty()) return;
  query_ = thinned_points(places, params.query_cell);
  grid_ = std::make_unique<MatchGrid>(places, grid);

  free_frame_ = seen.frame;
  free_.resize(free_frame_.size());
  for (std::size_t i = 0; i < free_.size(); ++i) free_[i] = seen.passed[i] > 0;
  const int reach = static_cast<int>(kMargin / params.free_cell);
  for (const Point2 p : places) {
    const CellIndex at = free_frame_.cell_at(p);
    for (int row = at.row - reach; row <= at.row + reach; ++row) {
      for (int column = at.column - reach; column <= at.column + reach; ++column) {
        if (free_frame_.holds({column, row})) free_[free_frame_.index({column, row})] = false;
      }
    }
  }
}

bool Submap::is_free(Point2 at) const {
  const CellIndex cell = free_frame_.cell_at(at);
  return free_frame_.holds(cell) && free_[free_frame_.index(cell)];
}

double share_in_conflict(const Submap& older, const Submap& newer, const Pose2& older_from_newer) {
  return std::max(share_on_free_floor(older, newer.query(), older_from_newer),
                  share_on_free_floor(newer, older.query(), inverse(older_from_newer)));
}

}  // namespace docent::mapping
