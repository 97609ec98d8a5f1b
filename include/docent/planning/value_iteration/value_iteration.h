#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/aligned_vector.h"
#include "docent/base/instruction_set.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/value_iteration/tile_kernel.h"

namespace docent::planning {

/// Value iteration on a grid [Rhino1999] 4.2, steps (1) to (5): V of a cell is the least cost of a way to
/// the nearest goal, where entering a neighbour costs that neighbour's cost times the step's length in cells.
///
/// The bounding box of step (5) is a set of tiles here (decision 0019): each is swept until nothing changes in it, the
/// tile with the least pending value first, and visited again only when a neighbour has something better to offer or
/// has lost what it offered.
///
/// Any-time: between calls steepest descent, wherever it finds a way, is a way to a goal. Deterministic, and the same
/// bit for bit with every instruction set, in whatever order changes and calls come.
class ValueIteration {
 public:
  static constexpr float kClosed = kUnreached;  ///< infinity: no way, or no place to be

  /// Where ways end.
  struct Goal {
    CellIndex cell;      ///< in the grid
    float value = 0.0F;  ///< cost that stands in for the rest of the way; 0 for the goal itself
  };
  /// A new cost of a cell.
  struct Change {
    CellIndex cell;        ///< in the grid
    float cost = kClosed;  ///< of entering it, > 0
  };

  /// @param frame  where the cells lie. All cells are closed until set_costs.
  explicit ValueIteration(const GridFrame& frame, InstructionSet set = instruction_sets().back());

  /// @param costs  [rows * columns] cost of entering a cell, > 0; kClosed where the robot cannot be. Compares all of
  /// them with what was before: O(cells), and then as change_costs.
  void set_costs(std::span<const float> costs);
  /// The map changed here. Marks what may have lost its ground, for the selective reset (step (4)), and what may fall.
  /// O(changes)
  void change_costs(std::span<const Change> changes);
  /// Starts over for these goals, step (1). Goals on closed cells count as well; a goal from where another one is
  /// nearer than its own value leads to that one.
  void set_goals(std::span<const Goal> goals);

  /// Works until nothing changes any more or `most_visits` tiles were visited; first the selective reset, then what
  /// falls. @returns true when the values have converged. O(kTileCells) a visit.
  bool iterate(int most_visits);
  /// The same, but only as far as it matters for the value of `cell`. @returns true when that value is final: what
  /// `iterate` would find in the end, and what a start from nothing would find. What lies farther from the goals may be
  /// left for `iterate`.
  bool settle(CellIndex cell, int most_visits);

  [[nodiscard]] bool is_settled() const { return falls_.empty() && losses_.empty(); }  ///< all values are final
  /// V; kClosed where no way is known.
  [[nodiscard]] float value(CellIndex cell) const;
  [[nodiscard]] float cost(CellIndex cell) const { return costs_[index(cell)]; }  ///< as last set
  [[nodiscard]] const GridFrame& frame() const { return frame_; }                 ///< where the cells lie
  /// A goal from where no other one is nearer.
  [[nodiscard]] bool is_goal(CellIndex cell) const;
  /// Offers of one cell to a neighbour that were computed so far, those of the selective reset among them.
  [[nodiscard]] std::uint64_t relaxations() const { return relaxations_; }

  /// Steepest descent in V from `start` (step (3)): the cells after it to a goal. Empty where no way is known.
  [[nodiscard]] std::vector<CellIndex> descend(CellIndex start) const;

 private:
  /// Borders of a tile, and where they lie in it.
  enum Side : std::size_t { kBottom, kTop, kLeft, kRight };
  static constexpr std::array kSides{kBottom, kTop, kLeft, kRight};
  static constexpr Side opposite(Side side) { return static_cast<Side>(side ^ 1U); }
  static std::size_t on_side(Side side, int k);

  /// Lines that must be swept whatever the neighbours offer, for something in them has changed.
  struct Stirred {
    std::uint64_t rows = 0;
    std::uint64_t columns = 0;
  };
  /// The bounding box of step (5), for each direction of its own: lines that what fell before them may lower.
  struct Pending {
    std::uint64_t forwards = 0;
    std::uint64_t backwards = 0;
    void after(std::uint64_t fallen);
    [[nodiscard]] bool any() const { return (forwards | backwards) != 0; }
  };
  struct Tile {
    float falls_from = kClosed;   ///< the least offer that was not taken yet
    float lost_from = kClosed;    ///< the least value that may have lost its ground
    float least = kClosed;        ///< of the values on its borders
    float most = 0.0F;            ///< of those that are finite
    bool is_blank = true;         ///< all values infinite, whatever the memory holds
    std::uint64_t lost_rows = 0;  ///< where that is
    Stirred stirred;
  };
  using Edge = std::array<float, kTileSide>;
  /// Copies of a tile's borders: its neighbours read them in one go.
  struct Edges {
    std::array<Edge, 4> values;
    std::array<Edge, 4> costs;
  };
  using Queue = std::priority_queue<std::pair<float, std::uint32_t>, std::vector<std::pair<float, std::uint32_t>>,
                                    std::greater<>>;
  struct Scratch {
    AlignedVector<float> values{AlignedVector<float>(kTileCells)}, costs{AlignedVector<float>(kTileCells)};
    AlignedVector<float> support{AlignedVector<float>(kTileCells)}, support_across{AlignedVector<float>(kTileCells)};
    AlignedVector<float> goals{AlignedVector<float>(kTileCells)};
  };

  /// What one call of `settle` resets: tiles together, or they would hold each other up.
  struct Repair {
    CellIndex wanted;                        ///< whose value
    std::vector<bool> takes_in;              ///< [tiles]
    std::uint64_t began = 0;                 ///< relaxations
    std::uint64_t most = ~std::uint64_t{0};  ///< relaxations that it may take; no bound until something broke
    int reach = 16;                          ///< [cells] from the robot's way
    int rounds = 0;
    bool is_straight = false;
  };

  [[nodiscard]] std::size_t tile_of(CellIndex cell) const;
  [[nodiscard]] std::size_t index(CellIndex cell) const;
  [[nodiscard]] std::ptrdiff_t neighbour(std::size_t tile, int columns, int rows) const;
  [[nodiscard]] const float* goals_of(std::size_t tile) const;
  void aim_at(std::optional<CellIndex> cell);
  [[nodiscard]] float least_cost_to(CellIndex cell, std::size_t tile) const;
  /// Sums of costs that are greater may round away more of a step than least_cost_to allows for.
  [[nodiscard]] float farthest() const { return least_cost_ * 0x1p17F; }
  void queue_fall(std::size_t tile, float from);
  void queue_loss(std::size_t tile, float from, std::uint64_t rows);
  void settle_next();

  // tile_work.cpp
  void unblank(std::size_t tile);
  void blank(std::size_t tile);
  [[nodiscard]] bool is_held_up(std::size_t tile) const;
  void copy_edges(std::size_t tile);
  template <class Take>
  void for_offers_into(std::size_t tile, bool firm, Take take);
  void settle_tile(std::size_t tile);
  bool sweep_both_ways(float* values, const float* costs, bool backwards_first, Pending& along, Pending& beside);
  void offer_to_neighbours(std::size_t tile);
  void reset_and_tell(std::size_t tile);
  bool reset_tile(std::size_t tile);
  void pass_on_losses(std::size_t tile, const std::array<Edge, 4>& before);

  // value_repair.cpp
  void widen(Repair& repair, std::span<const CellIndex> chain) const;
  int reset_all(const Repair& repair);
  [[nodiscard]] bool is_worth_it(const Repair& repair) const;
  void start_over(const Repair& repair);
  [[nodiscard]] std::optional<CellIndex> support_of(CellIndex cell) const;
  [[nodiscard]] bool knows_the_way(CellIndex cell) const;
  [[nodiscard]] std::uint64_t worth_repairing(const Repair& repair) const;
  [[nodiscard]] double sound_share(float sound) const;
  void start_over_above(float sound);

  GridFrame frame_;
  const TileKernels* kernels_;
  int tile_columns_;
  int tile_rows_;
  AlignedVector<float> costs_;   ///< [tiles][kTileCells]
  AlignedVector<float> values_;  ///< [tiles][kTileCells]
  std::vector<Edges> edges_;     ///< [tiles]
  std::vector<Tile> tiles_;
  std::map<std::size_t, AlignedVector<float>> goals_;  ///< of a tile that has some: their values, else infinite
  AlignedVector<float> no_goals_;
  float least_cost_ = kClosed;    ///< of all that were ever set
  std::optional<CellIndex> aim_;  ///< whose value `settle` wants; none: all
  std::vector<float> to_tile_;    ///< [tiles] lower bound of the cost from there to the tile; 0 without an aim
  Queue falls_;                   ///< (falls_from + to_tile_, tile), with entries that are out of date
  Queue losses_;                  ///< (lost_from, tile), likewise
  Scratch scratch_;
  std::uint64_t relaxations_ = 0;
  std::optional<std::uint64_t> started_at_;  ///< relaxations at set_goals, until its values have settled
  std::uint64_t work_a_tile_ = std::uint64_t{9} * kTileCells;  ///< relaxations that a start from nothing took
};

inline std::size_t ValueIteration::tile_of(CellIndex cell) const {
  return static_cast<std::size_t>(cell.row / kTileSide) * static_cast<std::size_t>(tile_columns_) +
         static_cast<std::size_t>(cell.column / kTileSide);
}

inline std::size_t ValueIteration::index(CellIndex cell) const {
  return tile_of(cell) * kTileCells + static_cast<std::size_t>(cell.row % kTileSide) * kTileSide +
         static_cast<std::size_t>(cell.column % kTileSide);
}

inline float ValueIteration::value(CellIndex cell) const {
  return tiles_[tile_of(cell)].is_blank ? kClosed : values_[index(cell)];
}

}  // namespace docent::planning
