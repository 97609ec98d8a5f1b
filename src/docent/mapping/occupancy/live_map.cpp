#include "docent/mapping/occupancy/live_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace docent::mapping {

Result<void> LiveMapParams::validate() const {
  if (coarsening < 1 || coarsening > 20) return fail("coarsening must be in 1..20");
  if (!(reach > 0.0)) return fail("reach must be > 0");
  if (!(static_margin >= 0.0)) return fail("static_margin must be >= 0");
  if (hits_to_block < 1 || hits_to_block > 4) return fail("hits_to_block must be in 1..4");
  if (!(forget > 0.0)) return fail("forget must be > 0");
  if (!(settle >= 0.0)) return fail("settle must be >= 0");
  if (!(forget_settled >= forget)) return fail("forget_settled must be >= forget");
  if (!(period > 0.0)) return fail("period must be > 0");
  if (auto valid = sonar.validate(); !valid) return fail("sonar." + valid.error().message);
  if (auto valid = infrared.validate(); !valid) return fail("infrared." + valid.error().message);
  if (auto valid = touch.validate(); !valid) return fail("touch." + valid.error().message);
  if (auto valid = sight.validate(); !valid) return fail("sight." + valid.error().message);
  return {};
}

namespace {

/// Cells of the coarse grid within `margin` [m] of what the map shows.
std::vector<bool> near_what_is_mapped(const OccupancyGrid& map, const GridFrame& grid, double margin) {
  std::vector<bool> solid(map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] < 0 || map.cells[i] >= 65;
  const auto distances = distance_transform(map.frame, solid);
  std::vector<bool> near(grid.size(), true);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const CellIndex fine = map.frame.cell_at(grid.centre({column, row}));
      if (!map.frame.holds(fine)) continue;
      near[grid.index({column, row})] = static_cast<double>(distances[map.frame.index(fine)]) <= margin;
    }
  }
  return near;
}

std::vector<bool> and_near_hazards(std::vector<bool> near, const GridFrame& grid, std::span<const Polygon> hazards,
                                   double margin) {
  for (const Polygon& hazard : hazards) {
    const auto [left, right] =
        std::minmax_element(hazard.begin(), hazard.end(), [](Point2 a, Point2 b) { return a.x < b.x; });
    const auto [low, high] =
        std::minmax_element(hazard.begin(), hazard.end(), [](Point2 a, Point2 b) { return a.y < b.y; });
    const CellIndex first = grid.cell_at({left->x - margin, low->y - margin});
    const CellIndex last = grid.cell_at({right->x + margin, high->y + margin});
    for (int row = std::max(0, first.row); row <= std::min(grid.rows - 1, last.row); ++row)
      for (int column = std::max(0, first.column); column <= std::min(grid.columns - 1, last.column); ++column)
        if (distance(hazard, grid.centre({column, row})) <= margin) near[grid.index({column, row})] = true;
  }
  return near;
}

}  // namespace

LiveMap::LiveMap(const OccupancyGrid& static_map, const LiveMapParams& params, std::span<const Polygon> hazards)
    : params_{params},
      static_{coarsened(static_map, params.coarsening)},
      near_static_{near_what_is_mapped(static_map, static_.frame, params.static_margin)},
      history_(static_.frame.size()),
      seen_(static_.frame.size()),
      blocked_since_(static_.frame.size()),
      settled_(static_.frame.size()),
      look_of_(static_.frame.size()),
      known_{and_near_hazards(near_static_, static_.frame, hazards, params.static_margin)},
      sonar_{static_.frame, known_, params.sonar},
      infrared_{static_.frame, known_, params.infrared},
      touch_{static_.frame, known_, params.touch} {}

bool LiveMap::is_seen(std::size_t index) const {
  const unsigned last_four = history_[index] & 0x0FU;
  return last_four != 0 && std::popcount(last_four) >= params_.hits_to_block;
}

std::int8_t LiveMap::live_cell(std::size_t index) const {
  std::int8_t most = 0;
  if (is_seen(index)) most = is_settled(index) ? kSettled : kPassing;
  for (const ConeLayer* layer : {&sonar_, &infrared_})
    if (layer->is_blocked(index)) most = std::max(most, layer->is_thing(index) ? kSettled : kPassing);
  const bool is_sighted = std::any_of(sights_.begin(), sights_.end(),
                                      [index](const auto& sight) { return sight.second.is_blocked(index); });
  return touch_.is_blocked(index) || is_sighted ? kSettled : most;
}

std::int8_t LiveMap::cell(std::size_t index) const {
  const std::int8_t live = live_cell(index);
  return live > 0 ? std::max(static_.cells[index], live) : static_.cells[index];
}

void LiveMap::mark(CellIndex cell, bool hit, Time now) {
  if (!static_.frame.holds(cell)) return;
  const std::size_t index = static_.frame.index(cell);
  const bool was_blocked = is_seen(index);
  const bool was_settled = was_blocked && settled_[index];
  if (look_of_[index] == look_) {
    // Hit and passed in one look: something stands in a part of the cell.
    history_[index] = static_cast<std::uint8_t>(history_[index] | (hit ? 1U : 0U));
  } else {
    look_of_[index] = look_;
    history_[index] = static_cast<std::uint8_t>(static_cast<unsigned>(history_[index]) << 1U | (hit ? 1U : 0U));
  }
  seen_[index] = now;
  if (!was_blocked && is_seen(index)) blocked_since_[index] = now;
  settled_[index] = is_seen(index) && to_seconds(now - blocked_since_[index]) >= params_.settle;
  if (was_blocked != is_seen(index) || was_settled != settled_[index]) widen(changes_, cell);
}

void LiveMap::look(Point2 sensor, std::span<const Point2> endpoints, Time now, double looked) {
  constexpr double kRounding = 0.01;  // [m]
  const double believed = std::min(params_.reach, looked - kRounding);
  ++look_;
  const double step = 0.5 * static_.frame.resolution;
  for (const Point2& endpoint : endpoints) {
    const double range = distance(sensor, endpoint);
    const double clear_to = std::min(range, params_.reach) - static_.frame.resolution;
    const Point2 along = range > 0.0 ? (1.0 / range) * (endpoint - sensor) : Point2{};
    for (double d = 0.0; d < clear_to; d += step) {
      const CellIndex cell = static_.frame.cell_at(sensor + d * along);
      if (!static_.frame.holds(cell)) continue;
      // That a second ray passes says nothing more.
      const std::size_t index = static_.frame.index(cell);
      if (history_[index] != 0 && look_of_[index] != look_) mark(cell, false, now);
    }
    if (range > believed) continue;
    const CellIndex cell = static_.frame.cell_at(endpoint);
    if (static_.frame.holds(cell) && !near_static_[static_.frame.index(cell)]) mark(cell, true, now);
  }
}

void LiveMap::forget(Time now) {
  sonar_.forget(now);
  infrared_.forget(now);
  touch_.forget(now);
  for (auto& [source, sight] : sights_) sight.forget(now);
  ++look_;
  for (int row = 0; row < static_.frame.rows; ++row) {
    for (int column = 0; column < static_.frame.columns; ++column) {
      const std::size_t index = static_.frame.index({column, row});
      if (history_[index] == 0) continue;
      const double memory = is_settled(index) ? params_.forget_settled : params_.forget;
      if (to_seconds(now - seen_[index]) < memory) continue;
      const Time seen = seen_[index];
      while (history_[index] != 0) {
        mark({column, row}, false, seen);
        ++look_;
      }
    }
  }
}

void LiveMap::add_sonar(const ConeReading& reading, std::span<const LaserLook> lasers, Time now) {
  sonar_.add(reading, lasers, now);
  for (const CellIndex gone : sonar_.take_gone())
    for (int row = gone.row - 1; row <= gone.row + 1; ++row)
      for (int column = gone.column - 1; column <= gone.column + 1; ++column) infrared_.release({column, row});
}

void LiveMap::add_touch(Point2 at, Point2 outward, std::span<const LaserLook> lasers, Time now) {
  for (const LaserLook& laser : lasers)
    for (const Point2& endpoint : laser.endpoints)
      if (distance(endpoint, at) < params_.touch.seen) return;
  touch_.feel(at, outward, now);
}

void LiveMap::add_lines(const std::string& source, Point2 robot, std::span<const Segment> lines,
                        std::span<const LaserLook> lasers, Time now) {
  constexpr std::size_t kMostSources = 8;
  auto sight = sights_.find(source);
  if (sight == sights_.end() && sights_.size() >= kMostSources) return;
  if (sight == sights_.end()) sight = sights_.try_emplace(source, static_.frame, known_, params_.sight).first;
  sight->second.see(robot, lines, lasers, now);
}

std::optional<CellRectangle> LiveMap::take_changes() {
  const auto add = [this](const std::optional<CellRectangle>& changes) {
    if (!changes) return;
    widen(changes_, changes->low);
    widen(changes_, changes->high);
  };
  for (const auto& changes : {sonar_.take_changes(), infrared_.take_changes(), touch_.take_changes()}) add(changes);
  for (auto& [source, sight] : sights_) add(sight.take_changes());
  return std::exchange(changes_, std::nullopt);
}

}  // namespace docent::mapping
