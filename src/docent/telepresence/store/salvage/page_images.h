#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace docent::telepresence {

/// The pages of an SQLite file as they were committed last, whatever became of the file: those of its WAL before its
/// own (https://www.sqlite.org/fileformat2.html). They point into what they were read from.
struct PageImages {
  std::size_t page_size = 4096;  ///< [bytes]
  std::size_t usable = 4096;     ///< [bytes] of it that SQLite fills
  std::map<std::uint32_t, std::string_view> pages;
  /// Of the WAL, where a checksum is wrong: page number and page, either of which may be it.
  struct Doubtful {
    std::uint32_t number = 0;
    std::string_view image;
    bool is_newest = false;  ///< of this number
  };
  std::vector<Doubtful> doubtful;
  /// What pages were before, the newest first: where a page is lost, these are all that is left.
  std::vector<std::pair<std::uint32_t, std::string_view>> older;
  /// Where a file ends within a page: that, filled up with zeros.
  std::vector<std::shared_ptr<const std::string>> filled;
};

/// What a WAL says of itself.
struct WalReport {
  std::size_t frames = 0;   ///< of this generation, that are there
  bool is_damaged = false;  ///< SQLite would leave out, and say nothing, what lies behind a wrong byte
};

/// @param is_cut  the end of the WAL is gone: what is left of its last transaction is doubtful, and not nobody's
[[nodiscard]] PageImages read_pages(std::string_view file, std::string_view wal, bool is_cut = false);
[[nodiscard]] WalReport look_at_wal(std::string_view wal);
/// Frames that the index of a WAL (the -shm) knows, of which nothing is in the file yet.
[[nodiscard]] std::size_t frames_only_in_wal(std::string_view index);
/// Whether it begins as an SQLite file does.
[[nodiscard]] bool has_sqlite_header(std::string_view file);

}  // namespace docent::telepresence
