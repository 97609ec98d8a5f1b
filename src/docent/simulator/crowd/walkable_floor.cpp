#include "docent/simulator/crowd/walkable_floor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kFloorCell = 0.1;    // [m]
constexpr double kCoarse = 0.2;       // [m]
constexpr double kFar = 1.5;          // [m] clearances are not told apart beyond
constexpr double kWalkable = 0.27;    // [m] clearance that a way needs
constexpr double kRoomy = 0.7;        // [m] clearance from which a way costs no more than its length
constexpr float kUnreachable = 1e9F;  // [m]
constexpr double kHeadroom = 2.0;     // [m] people walk below what hangs higher
constexpr std::array<std::array<int, 2>, 8> kNeighbours{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

constexpr float kBucket = 0.19F;  // [m] of a flow field's frontier
int bucket_of(float cost) { return static_cast<int>(cost * (1.0F / kBucket)); }

struct Box {
  Point2 low;
  Point2 high;
};

Box box_of(const Polygon& polygon) {
  Box box{polygon.front(), polygon.front()};
  for (const Point2 corner : polygon) {
    box.low = {std::min(box.low.x, corner.x), std::min(box.low.y, corner.y)};
    box.high = {std::max(box.high.x, corner.x), std::max(box.high.y, corner.y)};
  }
  return box;
}

}  // namespace

WalkableFloor::WalkableFloor(const World& world) {
  if (world.floor.size() < 3) return;
  const Box bounds = box_of(world.floor);
  low_ = bounds.low - Point2{kFloorCell, kFloorCell};
  columns_ = static_cast<int>(std::ceil((bounds.high.x - low_.x) / kFloorCell)) + 2;
  rows_ = static_cast<int>(std::ceil((bounds.high.y - low_.y) / kFloorCell)) + 2;
  clearance_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), static_cast<float>(kFar));

  const auto for_cells_near = [&](const Box& box, auto&& action) {
    const auto bound = [](double value, int limit) { return std::clamp(static_cast<int>(value), 0, limit - 1); };
    for (int row = bound((box.low.y - kFar - low_.y) / kFloorCell, rows_);
         row <= bound((box.high.y + kFar - low_.y) / kFloorCell, rows_); ++row) {
      for (int column = bound((box.low.x - kFar - low_.x) / kFloorCell, columns_);
           column <= bound((box.high.x + kFar - low_.x) / kFloorCell, columns_); ++column) {
        action(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column),
               low_ + Point2{(column + 0.5) * kFloorCell, (row + 0.5) * kFloorCell});
      }
    }
  };
  for (const Segment& side : sides(world.floor)) {
    for_cells_near(box_of({side.a, side.b}), [&](std::size_t cell, Point2 centre) {
      clearance_[cell] = std::min(clearance_[cell], static_cast<float>(distance(side, centre)));
    });
  }
  for_cells_near(bounds, [&](std::size_t cell, Point2 centre) {
    if (!contains(world.floor, centre)) clearance_[cell] = -clearance_[cell];
  });
  for (const Solid& solid : world.solids) {
    if (solid.polygon.size() < 3 || solid.bottom >= kHeadroom || is_litter(solid)) continue;
    for_cells_near(box_of(solid.polygon), [&](std::size_t cell, Point2 centre) {
      const double gap = outline_distance(solid.polygon, centre);
      const double signed_gap = gap < kFar && contains(solid.polygon, centre) ? -gap : gap;
      clearance_[cell] = std::min(clearance_[cell], static_cast<float>(signed_gap));
    });
  }

  coarse_columns_ = columns_ / 2 + 1;
  coarse_rows_ = rows_ / 2 + 1;
  coarse_clearance_.resize(static_cast<std::size_t>(coarse_columns_) * static_cast<std::size_t>(coarse_rows_));
  for (std::size_t cell = 0; cell < coarse_clearance_.size(); ++cell) {
    coarse_clearance_[cell] = static_cast<float>(clearance(coarse_centre(cell)));
  }
  for (std::size_t k = 0; k < kNeighbours.size(); ++k)
    to_neighbour_[k] = kNeighbours[k][1] * static_cast<std::ptrdiff_t>(coarse_columns_) + kNeighbours[k][0];
  weigh_steps();
  find_reachable(world);
}

void WalkableFloor::weigh_steps() {
  step_weight_.assign(coarse_clearance_.size(), 0.0F);
  // Nobody walks on the margin, so that every walkable cell has eight neighbours.
  for (int row = 1; row + 1 < coarse_rows_; ++row) {
    for (int column = 1; column + 1 < coarse_columns_; ++column) {
      const auto cell = static_cast<std::size_t>(row * coarse_columns_ + column);
      const float gap = coarse_clearance_[cell];
      if (gap < static_cast<float>(kWalkable)) continue;
      // People keep off walls where there is room.
      step_weight_[cell] = 1.0F + 2.0F * std::max(0.0F, static_cast<float>(kRoomy) - gap);
    }
  }
}

std::size_t WalkableFloor::fine_cell(Point2 point) const {
  const int column = std::clamp(static_cast<int>((point.x - low_.x) / kFloorCell), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>((point.y - low_.y) / kFloorCell), 0, rows_ - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
}

std::size_t WalkableFloor::coarse_cell(Point2 point) const {
  const int column = std::clamp(static_cast<int>((point.x - low_.x) / kCoarse), 0, coarse_columns_ - 1);
  const int row = std::clamp(static_cast<int>((point.y - low_.y) / kCoarse), 0, coarse_rows_ - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(coarse_columns_) + static_cast<std::size_t>(column);
}

Point2 WalkableFloor::coarse_centre(int column, int row) const {
  return low_ + Point2{(column + 0.5) * kCoarse, (row + 0.5) * kCoarse};
}

Point2 WalkableFloor::coarse_centre(std::size_t cell) const {
  return coarse_centre(static_cast<int>(cell) % coarse_columns_, static_cast<int>(cell) / coarse_columns_);
}

void WalkableFloor::find_reachable(const World& world) {
  // The part of the floor that hangs together with the entrance (or the home, or the largest one).
  const std::size_t count = clearance_.size();
  std::vector<std::uint8_t> component(count, 0);
  std::vector<std::uint32_t> best;
  double best_distance = 1e18;
  std::vector<std::uint32_t> stack;
  const Point2 anchor = world.entrances.empty() ? world.home : world.entrances.front();
  for (std::size_t seed = 0; seed < count; ++seed) {
    if (component[seed] != 0 || clearance_[seed] < static_cast<float>(kWalkable)) continue;
    std::vector<std::uint32_t> members;
    double nearest = 1e18;
    component[seed] = 1;
    stack.push_back(static_cast<std::uint32_t>(seed));
    while (!stack.empty()) {
      const std::size_t cell = stack.back();
      stack.pop_back();
      members.push_back(static_cast<std::uint32_t>(cell));
      const int column = static_cast<int>(cell) % columns_;
      const int row = static_cast<int>(cell) / columns_;
      nearest =
          std::min(nearest, distance(anchor, low_ + Point2{(column + 0.5) * kFloorCell, (row + 0.5) * kFloorCell}));
      for (int k = 0; k < 4; ++k) {
        const int c = column + kNeighbours[static_cast<std::size_t>(k)][0];
        const int r = row + kNeighbours[static_cast<std::size_t>(k)][1];
        if (c < 0 || r < 0 || c >= columns_ || r >= rows_) continue;
        const auto next = static_cast<std::size_t>(r * columns_ + c);
        if (component[next] != 0 || clearance_[next] < static_cast<float>(kWalkable)) continue;
        component[next] = 1;
        stack.push_back(static_cast<std::uint32_t>(next));
      }
    }
    // A pocket of less than 2 m2 is not a museum, however near the anchor.
    if (static_cast<double>(members.size()) * kFloorCell * kFloorCell > 2.0 && nearest < best_distance) {
      best_distance = nearest;
      best = std::move(members);
    }
  }
  usable_.assign(count, 0);
  for (const std::uint32_t cell : best) usable_[cell] = 1;
  usable_cells_ = best;
  std::sort(usable_cells_.begin(), usable_cells_.end());
  // The strip along walls, where no disc's centre fits, is floor too.
  std::size_t floor_cells = 0;
  constexpr int kStrip = 3;
  for (std::size_t cell = 0; cell < count; ++cell) {
    if (clearance_[cell] <= 0.0F) continue;
    const int column = static_cast<int>(cell) % columns_;
    const int row = static_cast<int>(cell) / columns_;
    bool near = false;
    for (int r = std::max(0, row - kStrip); r <= std::min(rows_ - 1, row + kStrip) && !near; ++r) {
      for (int c = std::max(0, column - kStrip); c <= std::min(columns_ - 1, column + kStrip) && !near; ++c) {
        near = usable_[static_cast<std::size_t>(r * columns_ + c)] != 0;
      }
    }
    if (near) ++floor_cells;
  }
  free_area_ = static_cast<double>(floor_cells) * kFloorCell * kFloorCell;
}

double WalkableFloor::clearance(Point2 point) const {
  if (columns_ == 0) return -kFar;
  const double x = (point.x - low_.x) / kFloorCell - 0.5;
  const double y = (point.y - low_.y) / kFloorCell - 0.5;
  if (!(x >= 0.0 && y >= 0.0 && x < columns_ - 1 && y < rows_ - 1)) return -kFar;
  const int column = static_cast<int>(x);
  const int row = static_cast<int>(y);
  const double fx = x - column;
  const double fy = y - row;
  const float* cell = clearance_.data() + static_cast<std::ptrdiff_t>(row) * columns_ + column;
  const double below = (1.0 - fx) * static_cast<double>(cell[0]) + fx * static_cast<double>(cell[1]);
  const double above = (1.0 - fx) * static_cast<double>(cell[columns_]) + fx * static_cast<double>(cell[columns_ + 1]);
  return (1.0 - fy) * below + fy * above;
}

Point2 WalkableFloor::away_from_walls(Point2 point) const {
  constexpr double kStep = 0.05;
  const Point2 gradient{clearance(point + Point2{kStep, 0.0}) - clearance(point - Point2{kStep, 0.0}),
                        clearance(point + Point2{0.0, kStep}) - clearance(point - Point2{0.0, kStep})};
  const double length = norm(gradient);
  return length > 1e-9 ? (1.0 / length) * gradient : Point2{};
}

bool WalkableFloor::is_clear(Point2 a, double at_a, Point2 b, double radius, double at_b) const {
  const Point2 way = b - a;
  double gap = at_a - radius;
  // The clearance falls by less than 1.5 m a metre: so far round b it is known to be enough.
  const double safe = std::max(0.0, (at_b - radius) / 1.5);
  if (safe > 0.0 && gap >= 0.0 && dot(way, way) < (gap + safe) * (gap + safe)) return true;
  const double length = norm(way);
  double along = 0.0;
  while (true) {
    if (gap < 0.0) return false;
    if (along >= length) return true;
    // Nothing can be nearer than the gap, so that step is safe.
    along = std::min(length, along + std::max(0.1, gap));
    if (length - along < safe) return true;
    gap = clearance(a + (along / length) * way) - radius;
  }
}

bool WalkableFloor::is_reachable(Point2 point) const {
  return clearance(point) > -1.0 && !usable_.empty() && usable_[fine_cell(point)] != 0;
}

std::optional<Point2> WalkableFloor::random_point(Rng& rng, double wanted) const {
  if (usable_cells_.empty()) return std::nullopt;
  for (int attempt = 0; attempt < 2000; ++attempt) {
    const auto pick = static_cast<std::size_t>(rng.integer(0, static_cast<std::int64_t>(usable_cells_.size()) - 1));
    const int cell = static_cast<int>(usable_cells_[pick]);
    const Point2 point =
        low_ + Point2{(cell % columns_ + rng.uniform()) * kFloorCell, (cell / columns_ + rng.uniform()) * kFloorCell};
    if (clearance(point) >= wanted) return point;
  }
  return std::nullopt;
}

std::optional<std::size_t> WalkableFloor::nearest_walkable(Point2 point, double limit) const {
  std::optional<std::size_t> best;
  double best_distance = limit;
  for_coarse_cells_within(point, limit, [&](std::size_t cell) {
    if (step_weight_[cell] <= 0.0F) return;
    const Point2 centre = coarse_centre(cell);
    const double away = distance(centre, point);
    if (away < best_distance && is_reachable(centre)) {
      best_distance = away;
      best = cell;
    }
  });
  return best;
}

FlowField WalkableFloor::field_to(Point2 goal, double reach) const {
  FlowField field;
  field.cost_.assign(coarse_clearance_.size(), kUnreachable);
  for_coarse_cells_within(goal, reach, [&](std::size_t cell) {
    if (step_weight_[cell] > 0.0F && is_reachable(coarse_centre(cell))) field.offer(cell, 0.0F);
  });
  if (field.pending_ == 0) {
    if (const auto nearest = nearest_walkable(goal, 50.0)) field.offer(*nearest, 0.0F);
  }
  return field;
}

void FlowField::offer(std::size_t cell, float cost) {
  cost_[cell] = cost;
  open(bucket_of(cost)).push_back(static_cast<std::uint32_t>(cell));
  ++pending_;
}

void WalkableFloor::grow(FlowField& field, std::size_t cell) const {
  // Dijkstra's algorithm with buckets narrower than the shortest step: within one nobody makes another cheaper, so any
  // order gives the same costs. The longest step goes less than all of them but one ahead.
  static_assert(kBucket < kCoarse &&
                kCoarse * 1.415 * (1.0 + 2.0 * (kRoomy - kWalkable)) < (FlowField::kBuckets - 1) * kBucket);
  const auto is_known = [&] {
    return field.cost_[cell] < kUnreachable && bucket_of(field.cost_[cell]) < field.bucket_;
  };
  for (; field.pending_ > 0 && !is_known(); ++field.bucket_) {
    auto& cells = field.open(field.bucket_);
    for (const std::uint32_t from : cells) {
      const float cost = field.cost_[from];
      if (bucket_of(cost) != field.bucket_) continue;  // has become cheaper since
      for (std::size_t k = 0; k < kNeighbours.size(); ++k) {
        const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(from) + to_neighbour_[k]);
        if (step_weight_[next] <= 0.0F) continue;
        const float length = static_cast<float>(kCoarse) * (k < 4 ? 1.0F : 1.41421356F);
        const float offered = cost + length * step_weight_[next];
        if (offered < field.cost_[next]) field.offer(next, offered);
      }
    }
    field.pending_ -= cells.size();
    cells.clear();
  }
}

template <class Action>
void WalkableFloor::for_coarse_cells_within(Point2 point, double reach, const Action& action) const {
  const auto bound = [](double value, int limit) {
    return static_cast<int>(std::clamp(value / kCoarse, 0.0, static_cast<double>(limit - 1)));
  };
  const Point2 low = point - low_ - Point2{reach + kCoarse, reach + kCoarse};
  const Point2 high = point - low_ + Point2{reach + kCoarse, reach + kCoarse};
  for (int row = bound(low.y, coarse_rows_); row <= bound(high.y, coarse_rows_); ++row) {
    for (int column = bound(low.x, coarse_columns_); column <= bound(high.x, coarse_columns_); ++column) {
      const auto cell = static_cast<std::size_t>(row * coarse_columns_ + column);
      if (distance(coarse_centre(cell), point) <= reach) action(cell);
    }
  }
}

std::optional<double> WalkableFloor::way(FlowField& field, Point2 point) const {
  constexpr double kAside = 1.0;  // [m] from the nearest cell where somebody walks
  const auto cell = field.is_empty() ? std::nullopt : nearest_walkable(point, kAside);
  if (!cell) return std::nullopt;
  grow(field, *cell);
  const float cost = field.cost_[*cell];
  return cost < kUnreachable ? std::optional{static_cast<double>(cost)} : std::nullopt;
}

std::optional<Point2> WalkableFloor::direction(FlowField& field, Point2 point, double radius) const {
  if (field.is_empty()) return std::nullopt;
  std::size_t cell = coarse_cell(point);
  if (step_weight_[cell] > 0.0F) grow(field, cell);
  if (field.cost_[cell] >= kUnreachable) {
    // Pressed against a wall: the best cell around.
    const int column = static_cast<int>(cell) % coarse_columns_;
    const int row = static_cast<int>(cell) / coarse_columns_;
    float least = kUnreachable;
    for (int r = std::max(0, row - 2); r <= std::min(coarse_rows_ - 1, row + 2); ++r) {
      for (int c = std::max(0, column - 2); c <= std::min(coarse_columns_ - 1, column + 2); ++c) {
        const auto next = static_cast<std::size_t>(r * coarse_columns_ + c);
        if (step_weight_[next] <= 0.0F) continue;
        grow(field, next);
        if (field.cost_[next] < least && is_clear(point, coarse_centre(next), 0.05)) {
          least = field.cost_[next];
          cell = next;
        }
      }
    }
    if (least >= kUnreachable) return std::nullopt;
    const Point2 step = coarse_centre(cell) - point;
    return norm(step) > 1e-6 ? std::optional{(1.0 / norm(step)) * step} : std::nullopt;
  }
  int column = static_cast<int>(cell) % coarse_columns_;
  int row = static_cast<int>(cell) / coarse_columns_;
  Point2 ahead = coarse_centre(column, row);
  const double room = clearance(point);
  const double width = std::min(radius, kWalkable - 0.02);
  constexpr int kLookAhead = 8;
  for (int i = 0; i < kLookAhead && field.cost_[cell] > 0.0F; ++i) {
    // Nobody walks on the margin: a cell that the goal is reached from has eight neighbours.
    const float* here = &field.cost_[cell];
    float least = *here;
    std::size_t best = kNeighbours.size();
    for (std::size_t k = 0; k < kNeighbours.size(); ++k) {
      const float cost = here[to_neighbour_[k]];
      if (cost >= least) continue;
      least = cost;
      best = k;
    }
    if (best == kNeighbours.size()) break;
    cell = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + to_neighbour_[best]);
    column += kNeighbours[best][0];
    row += kNeighbours[best][1];
    const Point2 centre = coarse_centre(column, row);
    if (i > 0 && !is_clear(point, room, centre, width, static_cast<double>(coarse_clearance_[cell]))) break;
    ahead = centre;
  }
  const Point2 step = ahead - point;
  const double length = norm(step);
  return length > 1e-6 ? std::optional{(1.0 / length) * step} : std::nullopt;
}

}  // namespace docent::simulator
