#include "docent/mapping/occupancy/scan_mapper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace docent::mapping {
namespace {

constexpr double kMostCells = 4e8;

double log_odds_of(double probability) { return std::log(probability / (1.0 - probability)); }

}  // namespace

Result<void> ScanMapperParams::validate() const {
  if (!(resolution >= 0.01 && resolution <= 1.0)) return fail("resolution must be 0.01..1 m");
  if (!(hit > 0.5 && hit < 1.0)) return fail("hit must be in (0.5, 1)");
  if (!(pass > 0.0 && pass < 0.5)) return fail("pass must be in (0, 0.5)");
  if (!(most_log_odds > 0.0)) return fail("most_log_odds must be > 0");
  if (!(reach > 0.0)) return fail("reach must be > 0 m");
  if (!(margin >= 0.0)) return fail("margin must be >= 0 m");
  if (!(empty_reach >= 0.0)) return fail("empty_reach must be >= 0 m");
  if (!(widest_gap >= 0.0 && widest_gap < 90.0)) return fail("widest_gap must be 0..90 degrees");
  if (!(widest_wall >= 0.0)) return fail("widest_wall must be >= 0 m");
  if (!(border >= 0.0)) return fail("border must be >= 0 m");
  if (!(free > 0.0 && free < occupied && occupied < 1.0))
    return fail("free and occupied must hold 0 < free < occupied < 1");
  if (!(most_free_pieces >= 0.0)) return fail("most_free_pieces must be >= 0");
  if (fewest_hits < 1 || fewest_hits > 255) return fail("fewest_hits must be 1..255");
  return {};
}

int fewest_hits_of(std::span<const Pose2> map_from_base) {
  constexpr double kSeenOver = 0.5;  // [m]
  std::vector<double> steps;
  for (std::size_t i = 1; i < map_from_base.size(); ++i)
    steps.push_back(distance(map_from_base[i - 1].position(), map_from_base[i].position()));
  if (steps.empty()) return 1;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle > 0.0 ? static_cast<int>(std::clamp(kSeenOver / *middle, 1.0, 3.0)) : 1;
}

Result<GridFrame> ScanMapper::frame_of(std::span<const PlacedSweep> sweeps, const ScanMapperParams& params) {
  if (sweeps.empty()) return fail("no scan to make a map of");
  Point2 low = sweeps.front().map_from_sensor.position();
  Point2 high = low;
  const auto include = [&](Point2 point) {
    low = {std::min(low.x, point.x), std::min(low.y, point.y)};
    high = {std::max(high.x, point.x), std::max(high.y, point.y)};
  };
  for (const PlacedSweep& placed : sweeps) {
    include(placed.map_from_sensor.position());
    for (const sensor_models::SweepBeam& beam : placed.sweep.beams)
      if (!beam.no_return && beam.range <= params.reach)
        include(placed.map_from_sensor * sensor_models::endpoint(beam));
  }
  const double columns = std::ceil((high.x - low.x + 2.0 * params.border) / params.resolution) + 1.0;
  const double rows = std::ceil((high.y - low.y + 2.0 * params.border) / params.resolution) + 1.0;
  if (!(columns * rows <= kMostCells)) return fail("the scans spread over more than 400 million cells");
  // Cell borders lie at multiples of the resolution, so that maps of parts of one log fit onto each other.
  const auto snap = [&](double value) { return params.resolution * std::floor(value / params.resolution); };
  return GridFrame{static_cast<int>(columns),
                   static_cast<int>(rows),
                   params.resolution,
                   {snap(low.x - params.border), snap(low.y - params.border)}};
}

ScanMapper::ScanMapper(const GridFrame& frame, const ScanMapperParams& params)
    : frame_{frame},
      params_{params},
      hit_{static_cast<float>(log_odds_of(params.hit))},
      pass_{static_cast<float>(log_odds_of(params.pass))},
      log_odds_(frame.size(), 0.0F),
      hits_(frame.size(), std::uint8_t{0}),
      met_(frame.size(), 0U),
      piece_log_odds_(frame.size(), 0.0F),
      met_by_(frame.size(), std::uint8_t{0}),
      freed_by_(frame.size(), std::uint8_t{0}) {}

void ScanMapper::add_evidence(CellIndex cell, float evidence) {
  if (!frame_.holds(cell)) return;
  const std::size_t index = frame_.index(cell);
  if (met_[index] == sweep_) return;
  met_[index] = sweep_;
  if (evidence > 0.0F && hits_[index] < 255) ++hits_[index];
  const auto most = static_cast<float>(params_.most_log_odds);
  log_odds_[index] = std::clamp(log_odds_[index] + evidence, -most, most);
  if (piece_log_odds_[index] == 0.0F) seen_in_piece_.push_back(index);
  piece_log_odds_[index] += evidence;
}

void ScanMapper::end_piece() {
  constexpr float kClearlyFree = 2.5F;  // passes
  for (const std::size_t index : seen_in_piece_) {
    const float odds = std::exchange(piece_log_odds_[index], 0.0F);
    if (odds > 0.0F && met_by_[index] < 255) ++met_by_[index];
    if (odds < kClearlyFree * pass_ && freed_by_[index] < 255) ++freed_by_[index];
  }
  seen_in_piece_.clear();
}

void ScanMapper::mark_line(Point2 from, Point2 to, float evidence) {
  const double length = distance(from, to);
  if (length <= 0.0) return;
  const Point2 along = (1.0 / length) * (to - from);
  const double step = 0.5 * frame_.resolution;
  for (double way = 0.0; way < length; way += step) add_evidence(frame_.cell_at(from + way * along), evidence);
}

void ScanMapper::clear_triangle(Point2 a, Point2 b, Point2 c) {
  const std::array<std::array<Point2, 2>, 3> edges{{{a, b}, {b, c}, {c, a}}};
  const int first = std::max(0, frame_.cell_at({0.0, std::min({a.y, b.y, c.y})}).row);
  const int last = std::min(frame_.rows - 1, frame_.cell_at({0.0, std::max({a.y, b.y, c.y})}).row);
  for (int row = first; row <= last; ++row) {
    const double y = frame_.centre({0, row}).y;
    double left = std::numeric_limits<double>::infinity();
    double right = -left;
    for (const auto& [from, to] : edges) {
      if ((from.y < y) == (to.y < y)) continue;  // the edge does not cross this row's middle
      const double x = from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (left > right) continue;
    const auto column_of = [&](double x) { return (x - frame_.origin.x) / frame_.resolution - 0.5; };
    const int begin = std::max(0, static_cast<int>(std::ceil(column_of(left))));
    const int end = std::min(frame_.columns - 1, static_cast<int>(std::floor(column_of(right))));
    for (int column = begin; column <= end; ++column) add_evidence({column, row}, pass_);
  }
}

bool ScanMapper::are_neighbours(std::span<const sensor_models::SweepBeam> beams, std::size_t i, std::size_t n) const {
  // The last beam of a full turn is the neighbour of the first.
  const double apart = std::abs(Angle::radians(beams[n].bearing - beams[i].bearing).radians());
  return n != i && apart <= params_.widest_gap * std::numbers::pi / 180.0;
}

const sensor_models::SweepBeam* ScanMapper::neighbour_of(std::span<const sensor_models::SweepBeam> beams, std::size_t i,
                                                         std::size_t n) const {
  return !beams[n].no_return && are_neighbours(beams, i, n) ? &beams[n] : nullptr;
}

std::vector<double> ScanMapper::clear_ranges(std::span<const sensor_models::SweepBeam> beams) const {
  std::vector<double> clear(beams.size(), 0.0);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].no_return) {
      clear[i] = std::min(params_.empty_reach, beams[i].range);
      continue;
    }
    const Point2 end = sensor_models::endpoint(beams[i]);
    double steepest = 0.0;  // sine of the angle at which the beam meets its surface
    bool is_alone = true;
    for (const std::size_t n : {i + 1 < beams.size() ? i + 1 : 0, i > 0 ? i - 1 : beams.size() - 1}) {
      const sensor_models::SweepBeam* const neighbour = neighbour_of(beams, i, n);
      if (neighbour == nullptr) continue;
      is_alone = false;
      const Point2 along = sensor_models::endpoint(*neighbour) - end;
      const Point2 across = unit(Angle::radians(beams[i].bearing + 0.5 * std::numbers::pi));
      steepest = std::max(steepest, std::abs(dot(across, along)) / std::max(norm(along), 1e-9));
    }
    const double margin = params_.margin / (is_alone ? 1.0 : std::max(steepest, 1e-6));
    clear[i] = std::max(0.0, std::min(beams[i].range - margin, params_.reach));
  }
  return clear;
}

void ScanMapper::add(const PlacedSweep& placed) {
  ++sweep_;
  const auto& beams = placed.sweep.beams;
  const Point2 sensor = placed.map_from_sensor.position();
  const auto next_of = [&](std::size_t i) { return i + 1 < beams.size() ? i + 1 : 0; };
  for (std::size_t i = 0; i < beams.size(); ++i) {  // hits first: they win
    if (beams[i].no_return || beams[i].range > params_.reach) continue;
    const Point2 end = placed.map_from_sensor * sensor_models::endpoint(beams[i]);
    add_evidence(frame_.cell_at(end), hit_);
    const sensor_models::SweepBeam* const neighbour = neighbour_of(beams, i, next_of(i));
    if (neighbour == nullptr || neighbour->range > params_.reach) continue;
    const Point2 next = placed.map_from_sensor * sensor_models::endpoint(*neighbour);
    if (distance(end, next) <= params_.widest_wall) mark_line(end, next, hit_);
  }
  const auto seen_to = [&](const sensor_models::SweepBeam& beam, double clear) {
    return sensor + clear * unit(placed.map_from_sensor.theta + Angle::radians(beam.bearing));
  };
  const std::vector<double> clear = clear_ranges(beams);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    mark_line(sensor, seen_to(beams[i], clear[i]), pass_);
    const double both = std::min(clear[i], clear[next_of(i)]);
    if (both <= 0.0 || !are_neighbours(beams, i, next_of(i))) continue;
    clear_triangle(sensor, seen_to(beams[i], both), seen_to(beams[next_of(i)], both));
  }
}

void ScanMapper::stand(Point2 centre, double radius) {
  ++sweep_;
  const CellIndex low = frame_.cell_at(centre - Point2{radius, radius});
  const CellIndex high = frame_.cell_at(centre + Point2{radius, radius});
  for (int row = low.row; row <= high.row; ++row) {
    for (int column = low.column; column <= high.column; ++column) {
      if (distance(frame_.centre({column, row}), centre) <= radius) add_evidence({column, row}, pass_);
    }
  }
}

OccupancyGrid ScanMapper::map() const {
  OccupancyGrid map{frame_, std::vector<std::int8_t>(frame_.size(), OccupancyGrid::kUnknown)};
  const auto occupied = static_cast<float>(log_odds_of(params_.occupied));
  const auto free = static_cast<float>(log_odds_of(params_.free));
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (log_odds_[i] >= occupied && hits_[i] >= params_.fewest_hits) map.cells[i] = OccupancyGrid::kOccupied;
    const bool is_passed = freed_by_[i] > params_.most_free_pieces * met_by_[i];
    if (log_odds_[i] <= free || (map.cells[i] == OccupancyGrid::kOccupied && is_passed))
      map.cells[i] = OccupancyGrid::kFree;
  }
  return map;
}

}  // namespace docent::mapping
