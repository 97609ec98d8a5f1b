#include "docent/people/free_memory.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "docent/geometry/point_transform.h"

namespace docent::people {
namespace {

constexpr std::int32_t kSide = 128;  // cells
constexpr double kCell = 0.1;        // [m]
constexpr double kReach = 6.2;       // [m]
constexpr std::int32_t kKept = 600;  // [0.1 s]: odometry drifts
constexpr double kBeforeEnd = 0.2;   // [m] of a beam that may be its end already
constexpr double kBody = 0.35;       // [m] the robot itself
constexpr std::int32_t kEvery = 2;   // [0.1 s]
constexpr std::int32_t kStays = 10;  // [0.1 s] after an end, beams that pass through the cell graze what stands there

std::size_t place_of(std::int32_t column, std::int32_t row) {
  static_assert((kSide & (kSide - 1)) == 0, "wraps by masking");
  constexpr auto kMask = static_cast<std::uint32_t>(kSide - 1);
  return static_cast<std::size_t>((static_cast<std::uint32_t>(row) & kMask) * static_cast<std::uint32_t>(kSide) +
                                  (static_cast<std::uint32_t>(column) & kMask));
}

/// Without a call into the library, and no way back to a double.
std::int32_t floor_of(double value) {
  const auto whole = static_cast<std::int32_t>(value);
  return whole - (value < static_cast<double>(whole) ? 1 : 0);
}

std::int32_t index_of(double metres) { return floor_of(metres / kCell); }

/// Cells of a beam's way, from kBody on, that are surely free.
int steps_of(const sensor_models::SweepBeam& beam) {
  return static_cast<int>((std::min(kReach, beam.range - kBeforeEnd) - kBody) / kCell) + 1;
}

/// Near the robot, beams lie closer than cells: there every eighth is enough, farther off every fourth and every other.
/// @returns the first step of the beam that its neighbours have not looked at
int first_step_of(const std::vector<sensor_models::SweepBeam>& beams, std::size_t i) {
  constexpr std::size_t kFew = 8;
  constexpr double kClose = 0.7;  // cells between two beams whose ways leave none out
  if (i % kFew == 0) return 0;
  const std::size_t apart = i & (~i + 1);  // the greatest power of two in it
  if (i + apart >= beams.size()) return 0;
  const sensor_models::SweepBeam& before = beams[i - apart];
  const sensor_models::SweepBeam& after = beams[i + apart];
  const double between = std::abs(after.bearing - before.bearing);
  if (!(between > 0.0 && between < 1.0)) return 0;  // where one laser's beams end and another's begin
  const int shared = static_cast<int>((kClose * kCell / between - kBody) / kCell);
  return std::max(0, std::min({shared, steps_of(before), steps_of(after)}));
}

}  // namespace

FreeMemory::FreeMemory() : cells_(static_cast<std::size_t>(kSide) * static_cast<std::size_t>(kSide)) {}

inline const FreeMemory::Cell* FreeMemory::find(std::int32_t column, std::int32_t row) const {
  const Cell& cell = cells_[place_of(column, row)];
  const bool is_it = cell.column == column && cell.row == row && now_ - cell.time <= kKept;
  return is_it ? &cell : nullptr;
}

inline FreeMemory::Cell& FreeMemory::touch(std::int32_t column, std::int32_t row) {
  Cell& cell = cells_[place_of(column, row)];
  if (cell.column != column || cell.row != row || now_ - cell.time > kKept) cell = {column, row, now_};
  cell.time = now_;
  return cell;
}

void FreeMemory::add(const sensor_models::RangeSweep& sweep, std::span<const sensor_models::BeamOrigin> origins,
                     const Pose2& odom_from_base, Time time) {
  const auto now = static_cast<std::int32_t>(time.nanoseconds / 100'000'000);
  if (now >= now_ && now - now_ < kEvery) return;  // every other sweep tells enough
  now_ = now;
  const Point2 from = odom_from_base.position();
  for (std::size_t b = 0; b < sweep.beams.size(); ++b) {
    const int first = first_step_of(sweep.beams, b);
    const int steps = steps_of(sweep.beams[b]);
    if (first >= steps) continue;
    const Point2 ray = unit(odom_from_base.theta + Angle::radians(sweep.beams[b].bearing));
    Point2 at = (1.0 / kCell) * (from + (kBody + first * kCell) * ray);  // in cells
    for (int i = first; i < steps; ++i, at = at + ray) {
      Cell& cell = touch(floor_of(at.x), floor_of(at.y));
      if (now - cell.end > kStays) cell.kind = Kind::free;
    }
  }
  const PointTransform of_points{odom_from_base};
  // Ends after ways: where one beam ends, another may have passed a hand's breadth away.
  for (std::size_t b = 0; b < sweep.beams.size(); ++b) {
    const sensor_models::SweepBeam& beam = sweep.beams[b];
    if (beam.no_return || beam.range > kReach) continue;
    const Point2 end = of_points * sensor_models::endpoint(beam);
    Cell& cell = touch(index_of(end.x), index_of(end.y));
    cell.end = now_;
    if (cell.kind == Kind::free) cell.kind = Kind::come;
    const bool is_mapped = origins[b] == sensor_models::BeamOrigin::map;
    if (cell.kind == Kind::unknown || (is_mapped && cell.kind == Kind::come)) cell.kind = Kind::standing;
  }
}

bool FreeMemory::has_come(Point2 in_odom) const {
  constexpr int kMost = 8;  // of nine cells
  constexpr std::array<std::array<std::int32_t, 2>, 4> kApart{{{2, 0}, {-2, 0}, {0, 2}, {0, -2}}};
  const std::int32_t column = index_of(in_odom.x);
  const std::int32_t row = index_of(in_odom.y);
  const Cell* here = find(column, row);
  if (here == nullptr || here->kind != Kind::come) return false;
  int known = 0;
  for (std::int32_t dr = -1; dr <= 1; ++dr) {
    for (std::int32_t dc = -1; dc <= 1; ++dc) {
      const Cell* cell = find(column + dc, row + dr);
      if (cell == nullptr || cell->kind == Kind::unknown) continue;
      if (has_stood(cell)) return false;
      ++known;
    }
  }
  // The faces of walls and furniture waver from cell to cell.
  for (const auto& [dc, dr] : kApart)
    if (has_stood(find(column + dc, row + dr))) return false;
  return known >= kMost;
}

void FreeMemory::mark_thing(Point2 in_odom) {
  Cell& cell = touch(index_of(in_odom.x), index_of(in_odom.y));
  if (cell.kind != Kind::come) cell.kind = Kind::thing;
}

bool FreeMemory::is_thing(Point2 in_odom) const {
  const std::int32_t column = index_of(in_odom.x);
  const std::int32_t row = index_of(in_odom.y);
  const Cell* here = find(column, row);
  if (here == nullptr || here->kind == Kind::come) return false;
  for (std::int32_t dr = -1; dr <= 1; ++dr)
    for (std::int32_t dc = -1; dc <= 1; ++dc)
      if (const Cell* cell = find(column + dc, row + dr); cell != nullptr && cell->kind == Kind::thing) return true;
  return false;
}

}  // namespace docent::people
