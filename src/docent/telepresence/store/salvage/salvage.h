#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "docent/telepresence/store/salvage/page_images.h"
#include "docent/telepresence/store/salvage/value.h"

namespace docent::telepresence {

/// A table or an index, as the schema has it.
struct SchemaEntry {
  std::string type, name, table, sql;  ///< sql: empty for an index that a PRIMARY KEY made
  std::uint32_t root = 0;              ///< 0: unknown
};

/// How the rows of a table look.
struct TableShape {
  struct Column {
    std::string name;
    std::string type;  ///< as declared
    bool may_be_null = true;
  };
  std::vector<Column> columns;
  [[nodiscard]] bool fits(const std::vector<Value>& row) const;  ///< it may have fewer columns, of an older version
};

struct SalvagedRow {
  std::int64_t id = 0;
  std::vector<Value> values;
};

/// What is left of a table.
struct SalvagedTable {
  std::map<std::int64_t, SalvagedRow> rows;
  /// Others that say the same id: one of the two is spoiled, or is what the row was before.
  std::vector<SalvagedRow> others;
  std::size_t lost_pages = 0;     ///< that its tree names, and that hold nothing of it
  std::size_t spoiled_pages = 0;  ///< of which some may be lost
};

/// The schema that a file holds; empty where that is lost.
[[nodiscard]] std::vector<SchemaEntry> salvage_schema(const PageImages& images);

/// Every row whose bytes are still there: through the trees of the tables, then in pages that no tree names any more,
/// where the shape of a row and the indexes tell whose it is. Within a page also rows that its own list has lost:
/// Debian's SQLite overwrites with zeros what is deleted, so what looks like a row is one.
[[nodiscard]] std::map<std::string, SalvagedTable> salvage_rows(const PageImages& images,
                                                                const std::vector<SchemaEntry>& schema,
                                                                const std::map<std::string, TableShape>& shapes);

}  // namespace docent::telepresence
