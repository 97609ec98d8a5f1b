#include "docent/telepresence/store/salvage/salvage.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>

#include "docent/telepresence/store/salvage/page_cells.h"

namespace docent::telepresence {
namespace {

constexpr std::size_t kSchemaColumns = 5;
constexpr std::string_view kNeverOlder = "sessions";  // one that has ended would begin again

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    const int more = first < 0x80 ? 0 : first >> 5U == 6 ? 1 : first >> 4U == 14 ? 2 : first >> 3U == 30 ? 3 : -1;
    if (more < 0) return false;
    for (int k = 0; k < more; ++k, ++i)
      if (i >= text.size() || (static_cast<unsigned char>(text[i]) >> 6U) != 2) return false;
  }
  return true;
}

bool has_word(const std::string& type, std::string_view word) {
  return std::search(type.begin(), type.end(), word.begin(), word.end(),
                     [](char a, char b) { return std::toupper(static_cast<unsigned char>(a)) == b; }) != type.end();
}

bool fits_column(const TableShape::Column& column, const Value& value) {
  if (std::holds_alternative<std::monostate>(value)) return column.may_be_null;
  const auto* text = std::get_if<std::string>(&value);
  if (has_word(column.type, "INT")) return std::holds_alternative<std::int64_t>(value);
  if (has_word(column.type, "REAL") || has_word(column.type, "DOUB")) return text == nullptr;
  if (has_word(column.type, "TEXT") || has_word(column.type, "CHAR")) return text != nullptr && is_utf8(*text);
  return true;
}

bool is_schema_row(const std::vector<Value>& row) {
  if (row.size() != kSchemaColumns) return false;
  const auto* type = std::get_if<std::string>(&row[0]);
  return type != nullptr && (*type == "table" || *type == "index" || *type == "view" || *type == "trigger") &&
         std::holds_alternative<std::string>(row[1]) && std::holds_alternative<std::string>(row[2]) &&
         std::holds_alternative<std::int64_t>(row[3]);
}

std::string text_of(const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : std::string{};
}

/// Calls `leaf` for each page of a tree that is not an inner one, and `lost` for each that is not there.
template <typename Leaf, typename Lost>
void walk(const PageImages& images, std::uint32_t root, std::set<std::uint32_t>& seen, const Leaf& leaf,
          const Lost& lost) {
  std::vector<std::uint32_t> to_do{root};
  while (!to_do.empty()) {
    const std::uint32_t number = to_do.back();
    to_do.pop_back();
    const auto image = images.pages.find(number);
    if (image == images.pages.end()) {
      lost();
    } else if (seen.insert(number).second) {
      const TreePage page{images, number, image->second};
      const auto below = page.children();
      to_do.insert(to_do.end(), below.begin(), below.end());
      if (below.empty() || page.kind() == PageKind::index_inside) leaf(number, page);
    }
  }
}

class Salvager {
 public:
  Salvager(const PageImages& images, const std::vector<SchemaEntry>& schema,
           const std::map<std::string, TableShape>& shapes)
      : images_{images}, schema_{schema}, shapes_{shapes} {}

  std::map<std::string, SalvagedTable> run() {
    for (const auto& [name, shape] : shapes_) found_[name].lost_pages = 0;
    for (const SchemaEntry& entry : schema_)
      if (entry.type == "table" && entry.root == 0 && shapes_.contains(entry.name)) ++found_[entry.name].lost_pages;
    for (const SchemaEntry& entry : schema_)
      if (entry.root > 1 && entry.type == "index") read_index(entry);
    for (const SchemaEntry& entry : schema_)
      if (entry.root > 1 && entry.type == "table" && shapes_.contains(entry.name)) read_table(entry);
    for (const auto& [number, image] : images_.pages)
      if (number > 1 && !seen_.contains(number)) read_stray(number, image, false);
    for (const auto& page : images_.doubtful)
      if (page.number != 1) read_stray(page.number, page.image, page.is_newest, page.is_newest ? "" : kNeverOlder);
    const bool is_whole = std::all_of(found_.begin(), found_.end(), [](const auto& table) {
      return table.second.lost_pages == 0 && table.second.spoiled_pages == 0;
    });
    for (const auto& [number, image] : images_.older)
      if (!is_whole && number != 1) read_stray(number, image, false, kNeverOlder);
    return std::move(found_);
  }

 private:
  void read_index(const SchemaEntry& entry) {
    auto& known = known_ids_[entry.table];
    walk(
        images_, entry.root, seen_,
        [&](std::uint32_t number, const TreePage& page) {
          const auto entries = page.entries();
          // What is no index is looked at again.
          if (page.kind() != PageKind::index_leaf && page.kind() != PageKind::index_inside) seen_.erase(number);
          for (const Cell& cell : entries)
            if (const auto* id = std::get_if<std::int64_t>(&cell.values.back());
                id != nullptr && cell.values.size() > 1)
              known.emplace(*id, text_of(cell.values.front()));
        },
        [] {});
  }

  void read_table(const SchemaEntry& entry) {
    const TableShape& shape = shapes_.at(entry.name);
    SalvagedTable& table = found_[entry.name];
    walk(
        images_, entry.root, seen_,
        [&](std::uint32_t number, const TreePage& page) {
          auto rows = page.rows([&](const auto& values) { return shape.fits(values); });
          owner_[number] = entry.name;
          if (!page.was_whole()) ++table.spoiled_pages;
          const bool is_empty_leaf = page.kind() == PageKind::table_leaf && page.is_empty();
          if (rows.empty() && !is_empty_leaf) {
            ++table.lost_pages;
            seen_.erase(number);  // it may be another's
          }
          for (Cell& row : rows)
            if (!row.is_remains || is_in_index(entry.name, row)) keep(table, std::move(row), false);
        },
        [&] { ++table.lost_pages; });
  }

  /// A page that belongs to nobody, or perhaps to somebody.
  void read_stray(std::uint32_t number, std::string_view image, bool is_newer, std::string_view but_for = {}) {
    const TreePage page{images_, number, image};
    if (page.kind() == PageKind::index_leaf || page.kind() == PageKind::index_inside) return;
    auto rows = page.rows([&](const auto& values) { return !tables_for(values).empty(); });
    const auto owner = owner_.find(number);
    for (Cell& row : rows) {
      const auto tables = tables_for(row.values);
      std::string best = tables.front();
      int most = -1;
      for (const std::string& table : tables) {
        const int score = (is_in_index(table, row) ? 4 : 0) +
                          (owner != owner_.end() && owner->second == table ? 2 : 0) +
                          (found_[table].lost_pages > 0 ? 1 : 0);
        if (score > most) best = table;
        most = std::max(most, score);
      }
      const bool is_deleted = row.is_remains && !is_in_index(best, row);
      if (best != but_for && !is_deleted) keep(found_[best], std::move(row), is_newer);
    }
  }

  [[nodiscard]] std::vector<std::string> tables_for(const std::vector<Value>& values) const {
    std::vector<std::string> tables;
    for (const auto& [name, shape] : shapes_)
      if (shape.columns.size() == values.size() && shape.fits(values)) tables.push_back(name);
    return tables;
  }
  [[nodiscard]] bool is_in_index(const std::string& table, const Cell& row) const {
    const auto known = known_ids_.find(table);
    if (known == known_ids_.end()) return false;
    const auto [first, last] = known->second.equal_range(row.id);
    return std::any_of(first, last, [&](const auto& key) {
      return std::any_of(row.values.begin(), row.values.end(),
                         [&](const Value& value) { return text_of(value) == key.second; });
    });
  }
  static void keep(SalvagedTable& table, Cell cell, bool is_newer) {
    const std::int64_t id = cell.id;
    SalvagedRow row{id, std::move(cell.values)};
    const auto [place, is_first] = table.rows.try_emplace(id, row);
    if (is_first || place->second.values == row.values) return;
    if (is_newer) std::swap(place->second, row);
    table.others.push_back(std::move(row));
  }

  const PageImages& images_;
  const std::vector<SchemaEntry>& schema_;
  const std::map<std::string, TableShape>& shapes_;
  std::map<std::string, SalvagedTable> found_;
  std::set<std::uint32_t> seen_;
  std::map<std::uint32_t, std::string> owner_;                                 ///< whose tree names a page
  std::map<std::string, std::multimap<std::int64_t, std::string>> known_ids_;  ///< of a table's indexes: id, key
};

}  // namespace

bool TableShape::fits(const std::vector<Value>& row) const {
  if (row.empty() || row.size() > columns.size()) return false;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (!fits_column(columns[i], row[i])) return false;
  return true;
}

std::vector<SchemaEntry> salvage_schema(const PageImages& images) {
  std::vector<SchemaEntry> schema;
  std::set<std::uint32_t> seen;
  walk(
      images, 1, seen,
      [&](std::uint32_t /*number*/, const TreePage& page) {
        for (const Cell& row : page.rows(is_schema_row))
          schema.push_back({text_of(row.values[0]), text_of(row.values[1]), text_of(row.values[2]),
                            text_of(row.values[4]), static_cast<std::uint32_t>(std::get<std::int64_t>(row.values[3]))});
      },
      [] {});
  return schema;
}

std::map<std::string, SalvagedTable> salvage_rows(const PageImages& images, const std::vector<SchemaEntry>& schema,
                                                  const std::map<std::string, TableShape>& shapes) {
  return Salvager{images, schema, shapes}.run();
}

}  // namespace docent::telepresence
