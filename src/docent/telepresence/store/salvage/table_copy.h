#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/telepresence/store/salvage/value.h"

struct sqlite3;

namespace docent::telepresence {

/// A small table that must outlive whatever becomes of its database lies beside it a second time, with a checksum:
/// that of the accounts, without whom nobody could say what happened.
struct TableCopy {
  static constexpr const char* kTable = "accounts";

  std::vector<std::string> columns;
  std::vector<std::vector<Value>> rows;

  /// As the database has it; nullopt: it has no such table.
  [[nodiscard]] static std::optional<TableCopy> of(sqlite3* database);
  /// nullopt: there is none, or it is damaged.
  [[nodiscard]] static std::optional<TableCopy> read(const std::filesystem::path& file);
  /// Whole or not at all, readable for its owner alone, and on the disk when it returns.
  [[nodiscard]] Result<void> write(const std::filesystem::path& file) const;

  /// The table becomes what the copy is: of a database that lost some of it. @returns rows that were not so
  [[nodiscard]] int restore(sqlite3* database) const;
  /// Rows with the same first column become what the copy is; others stay. @returns rows that were otherwise
  [[nodiscard]] int repair(sqlite3* database) const;

  bool operator==(const TableCopy&) const = default;

 private:
  int put(sqlite3* database, bool only_known) const;
};

}  // namespace docent::telepresence
