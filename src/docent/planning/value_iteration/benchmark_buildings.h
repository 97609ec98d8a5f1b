#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/value_iteration/value_iteration.h"

// Random buildings of 5 cm a cell for value_iteration_benchmark.cpp.

namespace docent::planning::benchmarks {

inline constexpr double kResolution = 0.05;  ///< [m/cell]

inline void fill(OccupancyGrid& map, int left, int bottom, int right, int top, std::int8_t as) {
  for (int row = std::max(0, bottom); row < std::min(top, map.frame.rows); ++row)
    for (int column = std::max(0, left); column < std::min(right, map.frame.columns); ++column)
      map.cells[map.frame.index({column, row})] = as;
}

inline OccupancyGrid floor_of(int side) {
  OccupancyGrid map;
  map.frame = {side, side, kResolution, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  return map;
}

/// One hall with cases of 0.3 to 3 m.
inline OccupancyGrid hall(int side, Rng& rng) {
  OccupancyGrid map = floor_of(side);
  for (int i = 0; i < side * side / 8000; ++i) {
    const int left = static_cast<int>(rng.integer(0, side));
    const int bottom = static_cast<int>(rng.integer(0, side));
    fill(map, left, bottom, left + static_cast<int>(rng.integer(6, 60)), bottom + static_cast<int>(rng.integer(6, 60)),
         OccupancyGrid::kOccupied);
  }
  return map;
}

/// Rooms of 5 to 12 m, most with a door of 1.2 m or two to their neighbours, and some furniture.
inline OccupancyGrid rooms(int side, Rng& rng) {
  OccupancyGrid map = floor_of(side);
  std::vector<int> walls{0};
  while (walls.back() < side) walls.push_back(walls.back() + static_cast<int>(rng.integer(100, 240)));
  const auto door = [&](int from, int to) {
    return static_cast<int>(rng.integer(from + 10, std::max(from + 11, to - 34)));
  };
  for (const int wall : walls) {
    fill(map, wall, 0, wall + 4, side, OccupancyGrid::kOccupied);
    fill(map, 0, wall, side, wall + 4, OccupancyGrid::kOccupied);
  }
  for (std::size_t i = 0; i + 1 < walls.size(); ++i) {
    for (const int wall : walls) {
      for (int doors = rng.chance(0.25) ? 2 : rng.chance(0.85) ? 1 : 0; doors > 0; --doors) {
        const int at = door(walls[i], walls[i + 1]);
        fill(map, wall, at, wall + 4, at + 24, OccupancyGrid::kFree);
        const int across = door(walls[i], walls[i + 1]);
        fill(map, across, wall, across + 24, wall + 4, OccupancyGrid::kFree);
      }
    }
  }
  for (int i = 0; i < side * side / 20000; ++i) {
    const int left = static_cast<int>(rng.integer(0, side));
    const int bottom = static_cast<int>(rng.integer(0, side));
    fill(map, left, bottom, left + static_cast<int>(rng.integer(6, 30)), bottom + static_cast<int>(rng.integer(6, 30)),
         OccupancyGrid::kOccupied);
  }
  return map;
}

/// Corridors of 2.6 m between walls of 0.2 m: a tree, with a tenth of the other walls taken out.
inline OccupancyGrid maze(int side, Rng& rng) {
  constexpr int kPitch = 56;
  OccupancyGrid map = floor_of(side);
  const int count = (side - 4) / kPitch;
  fill(map, 0, 0, side, side, OccupancyGrid::kOccupied);
  std::vector<int> group(static_cast<std::size_t>(count * count));
  std::iota(group.begin(), group.end(), 0);
  const std::function<int(int)> root = [&](int i) {
    while (group[static_cast<std::size_t>(i)] != i) i = group[static_cast<std::size_t>(i)];
    return i;
  };
  std::vector<std::pair<int, bool>> doors;  // of a place, to the right or up
  for (int i = 0; i < count * count; ++i) {
    const int left = 4 + i % count * kPitch;
    const int bottom = 4 + i / count * kPitch;
    fill(map, left, bottom, left + kPitch - 4, bottom + kPitch - 4, OccupancyGrid::kFree);
    if (i % count + 1 < count) doors.emplace_back(i, true);
    if (i / count + 1 < count) doors.emplace_back(i, false);
  }
  for (std::size_t i = doors.size(); i > 1; --i)
    std::swap(doors[i - 1], doors[static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(i) - 1))]);
  for (const auto& [place, right] : doors) {
    const int here = root(place);
    const int there = root(place + (right ? 1 : count));
    if (here == there && !rng.chance(0.1)) continue;
    group[static_cast<std::size_t>(here)] = there;
    const int left = 4 + place % count * kPitch;
    const int bottom = 4 + place / count * kPitch;
    if (right) {
      fill(map, left + kPitch - 4, bottom, left + kPitch, bottom + kPitch - 4, OccupancyGrid::kFree);
    } else {
      fill(map, left, bottom + kPitch - 4, left + kPitch - 4, bottom + kPitch, OccupancyGrid::kFree);
    }
  }
  return map;
}

/// As RoutePlanner gives them: closed within the robot's radius and a margin, dearer near to walls.
inline std::vector<float> costs_of(const OccupancyGrid& map) {
  std::vector<bool> solid(map.frame.size());
  for (std::size_t i = 0; i < solid.size(); ++i) solid[i] = map.cells[i] != OccupancyGrid::kFree;
  const auto clearances = distance_transform(map.frame, solid);
  std::vector<float> costs(map.frame.size(), ValueIteration::kClosed);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const double spare = static_cast<double>(clearances[i]) - 0.365;
    if (spare < 0.0) continue;
    const double discomfort = std::max(0.0, 1.0 - spare / 0.8);
    costs[i] = static_cast<float>(kResolution * (1.0 + 2.0 * discomfort * discomfort));
  }
  return costs;
}

}  // namespace docent::planning::benchmarks
