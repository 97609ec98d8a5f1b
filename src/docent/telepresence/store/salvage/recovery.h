#pragma once

#include <filesystem>
#include <string>

#include "docent/base/result.h"

namespace docent::telepresence {

/// What is left of a database: the bytes of its file and of its WAL, and what lies beside them.
struct Remains {
  std::string file, wal;
  std::filesystem::path copy;    ///< of its accounts; empty: there is none
  std::filesystem::path backup;  ///< its newest; empty: there is none
  bool is_cut = false;           ///< the end of the WAL is gone
};

struct Recovered {
  std::size_t rows = 0;         ///< that were read from file and WAL
  std::size_t lost_pages = 0;   ///< that were named and are not there, or hold nothing any more
  std::size_t from_backup = 0;  ///< rows that only the backup had
  int from_copy = 0;            ///< accounts that only their copy had as they were
  [[nodiscard]] std::string text() const;
};

/// Makes a new database of all that is left of one. Where pages are lost, what the newest backup has more is added, but
/// for wishes and logins: what was done and ended since would come again. The accounts are as their copy has them.
/// Whole and on the disk, or not there.
[[nodiscard]] Result<Recovered> recover(const Remains& remains, const std::filesystem::path& to);

/// "": the whole database is sound; else what is wrong. A program may have it open.
[[nodiscard]] std::string fault_of_database(const std::filesystem::path& file);

}  // namespace docent::telepresence
