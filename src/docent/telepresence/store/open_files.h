#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "docent/telepresence/store/sqlite_files.h"
#include "docent/telepresence/store/store_lock.h"

struct sqlite3;

namespace docent::telepresence {

/// The three files that a connection has open.
struct OpenFiles {
  FileMark file, wal, index;
  std::uintmax_t file_size = 0, wal_size = 0;  ///< [bytes] the largest: they never become smaller

  /// nullopt: one is not there.
  [[nodiscard]] static std::optional<OpenFiles> of(const SqliteFiles& files);
  /// "": they have their names still, and are as large as they were.
  [[nodiscard]] std::string look(const SqliteFiles& files);
};

/// What an open database has on its disk, whatever its files are called now. Read through SQLite's own descriptors: one
/// of ours, once closed, would take the locks of the process away.
[[nodiscard]] SqliteFiles::Bytes bytes_of(sqlite3* database);
/// Whether its file begins as a database does.
[[nodiscard]] bool begins_well(sqlite3* database);

}  // namespace docent::telepresence
