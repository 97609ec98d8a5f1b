#include "docent/mapping/occupancy/cone_layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "docent/geometry/point_transform.h"

namespace docent::mapping {

Result<void> ConeLayerParams::validate() const {
  if (!(reach > 0.0)) return fail("reach must be > 0");
  if (!(least_cone > 0.0 && least_cone < 0.7)) return fail("least_cone must be > 0 and < 0.7");
  if (!(hit > 0.0)) return fail("hit must be > 0");
  if (!(pass > 0.0)) return fail("pass must be > 0");
  if (!(least < 0.0)) return fail("least must be < 0");
  if (!(block > 0.0)) return fail("block must be > 0");
  if (!(most >= block)) return fail("most must be >= block");
  if (!(explain >= 0.0)) return fail("explain must be >= 0");
  if (!(forget > 0.0)) return fail("forget must be > 0");
  if (!(forget_thing >= forget)) return fail("forget_thing must be >= forget");
  return {};
}

ConeLayer::ConeLayer(const GridFrame& frame, std::vector<bool> known, const ConeLayerParams& params)
    : frame_{frame}, params_{params}, known_{std::move(known)} {
  evidence_.assign(frame.size(), 0.0F);
  blocked_.assign(frame.size(), false);
  thing_.assign(frame.size(), false);
  seen_.assign(frame.size(), Time{});
}

double ConeLayer::half_cone(const ConeReading& reading) const {
  constexpr double kWidest = 0.7;  // [rad]
  return std::clamp(0.5 * reading.field_of_view, params_.least_cone, kWidest);
}

/// The cells on the arc that lies `half` [rad] to both sides of the axis, each once.
std::vector<CellIndex> ConeLayer::arc(const ConeReading& reading, double half) const {
  const int steps = 1 + static_cast<int>(2.0 * half * reading.range / (0.5 * frame_.resolution));
  std::vector<CellIndex> cells;
  for (int i = 0; i <= steps; ++i) {
    const Angle bearing = Angle::radians(half * (2.0 * i / steps - 1.0));
    const CellIndex cell = frame_.cell_at(reading.map_from_sensor * (reading.range * unit(bearing)));
    if (frame_.holds(cell) && std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  }
  return cells;
}

LaserWord ConeLayer::ask(const ConeReading& reading, std::span<const LaserLook> lasers) const {
  // Half a cone more to each side, and nearer than the echo: it is what answered.
  const double slope = std::tan(2.0 * half_cone(reading));
  const double farthest = reading.range + params_.explain;
  const PointTransform sensor_from_map{inverse(reading.map_from_sensor)};
  const Point2 echo = reading.map_from_sensor * Point2{reading.range, 0.0};
  bool is_watched = false;
  for (const LaserLook& laser : lasers) {
    for (const Point2& endpoint : laser.endpoints) {
      const Point2 at = sensor_from_map * endpoint;
      if (at.x > 0.0 && std::abs(at.y) < slope * at.x && dot(at, at) < farthest * farthest) return LaserWord::meets;
    }
    const Point2 in_laser = inverse(laser.map_from_sensor) * echo;
    const double off = Angle::radians(std::atan2(in_laser.y, in_laser.x) - laser.first_bearing).radians();
    is_watched = is_watched || (off < 0.0 ? off + 2.0 * std::numbers::pi : off) <= laser.field;
  }
  return is_watched ? LaserWord::looks_over : LaserWord::does_not_look;
}

void ConeLayer::change(CellIndex cell, double evidence, bool is_thing, Time now) {
  const std::size_t i = frame_.index(cell);
  const bool was_blocked = blocked_[i];
  const bool was_thing = was_blocked && thing_[i];
  evidence_[i] = static_cast<float>(std::clamp(evidence, params_.least, params_.most));
  seen_[i] = now;
  blocked_[i] = static_cast<double>(evidence_[i]) >= params_.block || (was_blocked && evidence_[i] > 0.0F);
  thing_[i] = evidence_[i] > 0.0F && (thing_[i] || is_thing);
  if (was_blocked != blocked_[i] || was_thing != this->is_thing(i)) widen(changes_, cell);
}

void ConeLayer::clear(const ConeReading& reading, Time now) {
  const double farthest = std::min({reading.range, reading.max_range, params_.reach}) - frame_.resolution;
  if (!(farthest > 0.0)) return;
  const double half = half_cone(reading);
  std::optional<CellRectangle> box;
  for (const double share : {-1.0, 0.0, 1.0}) {
    const Point2 corner = (farthest / std::cos(half)) * unit(Angle::radians(share * half));
    widen(box, frame_.cell_at(reading.map_from_sensor * corner));
  }
  widen(box, frame_.cell_at(reading.map_from_sensor.position()));
  const PointTransform sensor_from_map{inverse(reading.map_from_sensor)};
  const double slope = std::tan(half);
  for (int row = std::max(0, box->low.row); row <= std::min(frame_.rows - 1, box->high.row); ++row) {
    for (int column = std::max(0, box->low.column); column <= std::min(frame_.columns - 1, box->high.column);
         ++column) {
      const Point2 at = sensor_from_map * frame_.centre({column, row});
      // A cell that the cone's edge cuts, too: between the cones of a ring, which begin apart, nothing is left out.
      const double beside = slope * at.x + 0.5 * frame_.resolution;
      if (at.x <= 0.0 || std::abs(at.y) > beside || dot(at, at) > farthest * farthest) continue;
      const std::size_t i = frame_.index({column, row});
      const bool was_blocked = blocked_[i];
      change({column, row}, static_cast<double>(evidence_[i]) - params_.pass, false, now);
      if (was_blocked && !blocked_[i]) gone_.push_back({column, row});
    }
  }
}

void ConeLayer::add(const ConeReading& reading, std::span<const LaserLook> lasers, Time now) {
  if (!(reading.range > 0.0)) return;  // not a number, or covered
  clear(reading, now);
  if (reading.range >= std::min(reading.max_range, params_.reach)) return;
  const double half = half_cone(reading);
  const auto wide = arc(reading, 2.0 * half);
  if (std::any_of(wide.begin(), wide.end(), [&](CellIndex cell) { return known_[frame_.index(cell)]; })) return;
  const LaserWord word = ask(reading, lasers);
  if (word == LaserWord::meets) return;
  for (const CellIndex cell : arc(reading, half)) {
    const double before = evidence_[frame_.index(cell)];
    change(cell, before + params_.hit, word == LaserWord::looks_over, now);
  }
}

void ConeLayer::forget(Time now) {
  for (int row = 0; row < frame_.rows; ++row) {
    for (int column = 0; column < frame_.columns; ++column) {
      const std::size_t i = frame_.index({column, row});
      if (evidence_[i] == 0.0F) continue;
      const double memory = is_thing(i) ? params_.forget_thing : params_.forget;
      if (to_seconds(now - seen_[i]) >= memory) change({column, row}, 0.0, false, seen_[i]);
    }
  }
}

void ConeLayer::release(CellIndex cell) {
  if (frame_.holds(cell)) change(cell, 0.0, false, seen_[frame_.index(cell)]);
}

std::optional<CellRectangle> ConeLayer::take_changes() { return std::exchange(changes_, std::nullopt); }

}  // namespace docent::mapping
