#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent {

/// A cell of a grid; may lie outside.
struct CellIndex {
  int column = 0;  ///< from the left, 0 the first
  int row = 0;     ///< from below, 0 the first
  friend bool operator==(const CellIndex&, const CellIndex&) = default;
};  ///< Never mixed with metres: only the grid converts.

/// Where cells lie: row-major, cell (0,0) has its lower-left corner at the origin; no rotation.
struct GridFrame {
  int columns = 0;           ///< number of cells from left to right
  int rows = 0;              ///< number of cells from bottom to top
  double resolution = 0.05;  ///< [m/cell]
  Point2 origin{};           ///< [m], lower-left corner of cell (0,0) in the map's frame

  /// Cells.
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  /// Whether the cell lies in the grid.
  [[nodiscard]] bool holds(CellIndex cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns && cell.row < rows;
  }
  /// Its place in row-major arrays. @pre holds(cell).
  [[nodiscard]] std::size_t index(CellIndex cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(cell.column);
  }
  /// The cell that holds the point, also outside the grid (see holds).
  [[nodiscard]] CellIndex cell_at(Point2 in_map) const {
    return {static_cast<int>(std::floor((in_map.x - origin.x) / resolution)),
            static_cast<int>(std::floor((in_map.y - origin.y) / resolution))};
  }
  /// [m], map.
  [[nodiscard]] Point2 centre(CellIndex cell) const {
    return {origin.x + (cell.column + 0.5) * resolution, origin.y + (cell.row + 0.5) * resolution};
  }
};

/// Occupancy map as map_server writes it. Cells hold 0..100 (percent occupied) or kUnknown.
struct OccupancyGrid {
  static constexpr std::int8_t kUnknown = -1;    ///< never seen
  static constexpr std::int8_t kFree = 0;        ///< 0 %
  static constexpr std::int8_t kOccupied = 100;  ///< 100 %

  GridFrame frame;                 ///< where the cells lie
  std::vector<std::int8_t> cells;  ///< [rows * columns]

  /// The cell's value; kUnknown outside.
  [[nodiscard]] std::int8_t at(CellIndex cell) const { return frame.holds(cell) ? cells[frame.index(cell)] : kUnknown; }
  [[nodiscard]] bool is_occupied(CellIndex cell) const { return at(cell) >= 65; }  ///< 65 % and more
  /// Below 20 %, and known.
  [[nodiscard]] bool is_free(CellIndex cell) const { return at(cell) >= 0 && at(cell) < 20; }
};

/// A map as a file has it, and what a person should know of how it was read: keys that nobody knows, a turn, a file
/// that is longer than it says.
struct LoadedMap {
  OccupancyGrid map;               ///< along the axes
  std::vector<std::string> notes;  ///< for a person
};

/// Reads a map_server YAML and its PGM (P2, P5) or PNG image. Faults name file and line. An origin with a yaw turns the
/// map into a grid along the axes; of an image of more than 25 million pixels whose rim is unknown, what is known is
/// kept.
[[nodiscard]] Result<LoadedMap> read_map(const std::filesystem::path& yaml);
/// The same without the notes.
[[nodiscard]] Result<OccupancyGrid> load_map(const std::filesystem::path& yaml);
/// Writes PATH.yaml and PATH.pgm, each atomically.
[[nodiscard]] Result<void> save_map(const OccupancyGrid& map, const std::filesystem::path& path_without_extension);
/// Hash of frame and cells, as 16 hexadecimal digits: names a map in messages, checkpoints and caches.
[[nodiscard]] std::string map_hash(const OccupancyGrid& map);

/// A coarser map: a cell is occupied if any cell under it is, unknown if all are. @pre factor >= 1
[[nodiscard]] OccupancyGrid coarsened(const OccupancyGrid& map, int factor);

/// Distance [m] from every cell's centre to the nearest occupied cell's centre; exact Euclidean, O(cells).
/// Felzenszwalb and Huttenlocher, Distance transforms of sampled functions. Where nothing is occupied: +infinity.
[[nodiscard]] std::vector<float> distance_transform(const GridFrame& frame, const std::vector<bool>& occupied);

}  // namespace docent
