#include "docent/grid/occupancy_grid.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <limits>
#include <string_view>

#include "docent/base/random.h"

namespace docent {

std::string map_hash(const OccupancyGrid& map) {
  const auto bytes_of = [](const auto& value) {
    return std::string_view{reinterpret_cast<const char*>(&value), sizeof value};
  };
  std::uint64_t hash = hash_of(bytes_of(map.frame.columns));
  hash = hash_of(bytes_of(map.frame.rows), hash);
  hash = hash_of(bytes_of(map.frame.resolution), hash);
  hash = hash_of(bytes_of(map.frame.origin), hash);
  hash = hash_of({reinterpret_cast<const char*>(map.cells.data()), map.cells.size()}, hash);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

OccupancyGrid coarsened(const OccupancyGrid& map, int factor) {
  OccupancyGrid result;
  result.frame = map.frame;
  result.frame.columns = (map.frame.columns + factor - 1) / factor;
  result.frame.rows = (map.frame.rows + factor - 1) / factor;
  result.frame.resolution = map.frame.resolution * factor;
  result.cells.assign(result.frame.size(), OccupancyGrid::kUnknown);
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      auto& cell = result.cells[result.frame.index({column / factor, row / factor})];
      cell = std::max(cell, map.cells[map.frame.index({column, row})]);
    }
  }
  return result;
}

namespace {

/// [cells] to the nearest occupied cell of the same column; infinity where it has none. Row by row: a pass in order of
/// memory each way.
std::vector<float> cells_within_column(const GridFrame& frame, const std::vector<bool>& occupied) {
  const auto columns = static_cast<std::size_t>(frame.columns);
  std::vector<float> cells(frame.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (occupied[i]) {
      cells[i] = 0.0F;
    } else if (i >= columns) {
      cells[i] = cells[i - columns] + 1.0F;
    }
  }
  for (std::size_t i = cells.size(); i-- > columns;) cells[i - columns] = std::min(cells[i - columns], cells[i] + 1.0F);
  return cells;
}

/// Lower envelope of parabolas: the squared distance transform of one line, in place.
class LineTransform {
 public:
  explicit LineTransform(std::size_t longest) : sites_(longest), borders_(longest + 1), input_(longest) {}

  void operator()(float* values, std::size_t count) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) input_[i] = static_cast<double>(values[i]);
    std::size_t used = 0;
    for (std::size_t q = 0; q < count; ++q) {
      if (input_[q] == kInfinity) continue;
      double border = -kInfinity;
      while (used > 0) {
        const std::size_t v = sites_[used - 1];
        const auto x = static_cast<double>(q);
        const auto y = static_cast<double>(v);
        border = ((input_[q] + x * x) - (input_[v] + y * y)) / (2.0 * (x - y));
        if (border > borders_[used - 1]) break;
        --used;
      }
      if (used == 0) border = -kInfinity;
      sites_[used] = q;
      borders_[used] = border;
      ++used;
    }
    if (used == 0) return;
    borders_[used] = kInfinity;
    std::size_t k = 0;
    for (std::size_t q = 0; q < count; ++q) {
      while (k + 1 < used && borders_[k + 1] < static_cast<double>(q)) ++k;
      const double offset = static_cast<double>(q) - static_cast<double>(sites_[k]);
      values[q] = static_cast<float>(offset * offset + input_[sites_[k]]);
    }
  }

 private:
  std::vector<std::size_t> sites_;
  std::vector<double> borders_;
  std::vector<double> input_;
};

}  // namespace

std::vector<float> distance_transform(const GridFrame& frame, const std::vector<bool>& occupied) {
  const auto columns = static_cast<std::size_t>(frame.columns);
  const auto rows = static_cast<std::size_t>(frame.rows);
  std::vector<float> squared = cells_within_column(frame, occupied);
  for (float& cells : squared) cells *= cells;
  LineTransform transform{columns};
  for (std::size_t row = 0; row < rows; ++row) transform(squared.data() + row * columns, columns);
  for (auto& value : squared) value = static_cast<float>(std::sqrt(static_cast<double>(value)) * frame.resolution);
  return squared;
}

}  // namespace docent
