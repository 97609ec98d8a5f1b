#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "docent/telepresence/store/salvage/page_images.h"
#include "docent/telepresence/store/salvage/value.h"

namespace docent::telepresence {

enum class PageKind : std::uint8_t { index_inside = 2, table_inside = 5, index_leaf = 10, table_leaf = 13, other = 0 };

/// One row of a table, or one entry of an index, whose last value is the row's id.
struct Cell {
  std::int64_t id = 0;  ///< of a table's row
  std::vector<Value> values;
  bool is_remains = false;  ///< it stands where cells have been before: it was moved, or deleted
};

/// One page of a tree, read with suspicion.
class TreePage {
 public:
  TreePage(const PageImages& images, std::uint32_t number, std::string_view image);
  [[nodiscard]] PageKind kind() const { return kind_; }
  [[nodiscard]] bool is_empty() const;  ///< it lists nothing
  /// Of an inner page: those below, as far as there are such.
  [[nodiscard]] std::vector<std::uint32_t> children() const;
  using IsRow = std::function<bool(const std::vector<Value>&)>;
  /// All that can be read as a row of a table; where the page's own list is not whole, also what is not listed.
  [[nodiscard]] std::vector<Cell> rows(const IsRow& is_row) const;
  /// Of a leaf of a table: whether the last `rows` found all that the page lists, and nothing between.
  [[nodiscard]] bool was_whole() const { return was_whole_; }
  /// Of an index, leaf or not: its entries.
  [[nodiscard]] std::vector<Cell> entries() const;

 private:
  [[nodiscard]] std::vector<std::size_t> listed(std::size_t header) const;
  [[nodiscard]] std::size_t first_cell() const;
  [[nodiscard]] std::optional<std::size_t> free_bytes() const;
  [[nodiscard]] std::optional<Cell> cell_at(std::size_t at, bool has_id, std::size_t& end) const;

  const PageImages& images_;
  std::string_view image_;
  std::size_t begin_;  ///< of its header: page 1 has that of the file before it
  PageKind kind_;
  mutable bool was_whole_ = true;
};

}  // namespace docent::telepresence
