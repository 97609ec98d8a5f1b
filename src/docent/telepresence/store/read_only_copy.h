#pragma once

#include <filesystem>
#include <memory>

#include "docent/base/result.h"
#include "docent/telepresence/store/sqlite_files.h"

namespace SQLite {
class Database;
class Exception;
}  // namespace SQLite

namespace docent::telepresence {

/// What a file and its WAL hold, in memory and for reading alone: on a disk that takes nothing SQLite opens no WAL, and
/// whoever has logged in is to be known all the same. Error: they hold no whole database.
[[nodiscard]] Result<std::unique_ptr<SQLite::Database>> read_only_copy(const SqliteFiles::Bytes& bytes);

/// Whether that is why SQLite could not write, or open the index of a WAL: the disk has no room, or files of this
/// process none.
[[nodiscard]] bool is_of_full_disk(const SQLite::Exception& why, const std::filesystem::path& file);

}  // namespace docent::telepresence
