#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// Cost to go to one place from everywhere that people can walk, on cells of 0.2 m. It grows round the place as far as
/// it is asked for.
class FlowField {
 public:
  [[nodiscard]] bool is_empty() const { return cost_.empty(); }
  void clear() { cost_.clear(); }

 private:
  friend class WalkableFloor;
  static constexpr int kBuckets = 4;
  [[nodiscard]] std::vector<std::uint32_t>& open(int bucket) {
    return open_[static_cast<std::size_t>(bucket % kBuckets)];
  }
  void offer(std::size_t cell, float cost);

  std::vector<float> cost_;                                ///< [m, weighted]; >= 1e9 where the goal is not reached from
  std::array<std::vector<std::uint32_t>, kBuckets> open_;  ///< whose cost may yet fall, in buckets by cost
  std::size_t pending_ = 0;                                ///< cells in these
  int bucket_ = 0;                                         ///< whose cost is in a lower one has it for good
};

/// Where people can walk: clearance to walls, furniture and hazards on a 0.1 m grid, and ways through the building.
class WalkableFloor {
 public:
  explicit WalkableFloor(const World& world);

  /// Distance from a point to the nearest thing in the way [m], negative inside it, at most 1.5. Bilinear between cell
  /// centres: good to a few centimetres. O(1).
  [[nodiscard]] double clearance(Point2 point) const;
  /// Unit vector along which the clearance grows; zero in the open.
  [[nodiscard]] Point2 away_from_walls(Point2 point) const;
  /// True when a disc can move straight from a to b.
  [[nodiscard]] bool is_clear(Point2 a, Point2 b, double radius) const { return is_clear(a, clearance(a), b, radius); }
  /// True where a person can stand and walk to the rest of the museum.
  [[nodiscard]] bool is_reachable(Point2 point) const;
  /// Free floor of the part that hangs together with the entrance [m2].
  [[nodiscard]] double free_area() const { return free_area_; }
  /// Lower left and upper right corner of all that clearance() tells [m].
  [[nodiscard]] std::pair<Point2, Point2> bounds() const { return {low_, low_ + Point2{0.1 * columns_, 0.1 * rows_}}; }
  /// A uniform draw from the reachable floor with at least `clearance`; nullopt after 2,000 misses.
  [[nodiscard]] std::optional<Point2> random_point(Rng& rng, double clearance) const;

  /// Ways to all points within `reach` of `goal`, or to the nearest reachable point. O(cells), when it has grown.
  [[nodiscard]] FlowField field_to(Point2 goal, double reach) const;
  /// How far it is to walk from `point` [m, more where it is narrow]; nullopt: no way.
  [[nodiscard]] std::optional<double> way(FlowField& field, Point2 point) const;
  /// Which way to walk from `point`: looks a few cells ahead. nullopt: no way.
  [[nodiscard]] std::optional<Point2> direction(FlowField& field, Point2 point, double radius) const;

 private:
  [[nodiscard]] std::size_t fine_cell(Point2 point) const;
  [[nodiscard]] std::size_t coarse_cell(Point2 point) const;
  [[nodiscard]] Point2 coarse_centre(int column, int row) const;
  [[nodiscard]] Point2 coarse_centre(std::size_t cell) const;
  [[nodiscard]] std::optional<std::size_t> nearest_walkable(Point2 point, double limit) const;
  /// @param at_a  the clearance there. @param at_b  likewise where it is known, else 0
  [[nodiscard]] bool is_clear(Point2 a, double at_a, Point2 b, double radius, double at_b = 0.0) const;
  /// Until the cost of that cell is known.
  void grow(FlowField& field, std::size_t cell) const;
  template <class Action>
  void for_coarse_cells_within(Point2 point, double reach, const Action& action) const;
  void find_reachable(const World& world);
  void weigh_steps();

  Point2 low_{};
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> clearance_;      ///< [rows * columns]
  std::vector<std::uint8_t> usable_;  ///< [rows * columns] 1: reachable floor
  std::vector<std::uint32_t> usable_cells_;
  double free_area_ = 0.0;
  int coarse_columns_ = 0;
  int coarse_rows_ = 0;
  std::array<std::ptrdiff_t, 8> to_neighbour_{};  ///< from a coarse cell to those round it
  std::vector<float> coarse_clearance_;
  std::vector<float> step_weight_;  ///< of each coarse cell: what a metre into it costs; 0: nobody walks there
};

}  // namespace docent::simulator
