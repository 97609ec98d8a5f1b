#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::telepresence {

/// Which file it is, whatever its name is now.
struct FileMark {
  std::uint64_t device = 0, number = 0;
  [[nodiscard]] static std::optional<FileMark> of(const std::filesystem::path& file);  ///< nullopt: it is not there
  auto operator<=>(const FileMark&) const = default;
};

/// What all connections to one database file tell each other through FILE.lock, in this process and in others.
class StoreLock {
 public:
  enum class Part : std::uint8_t {
    files,   ///< whoever opens, mends or replaces the files
    use,     ///< shared: the database is open
    commit,  ///< shared: something is being committed; alone: nothing is
  };
  enum class Kind : std::uint8_t { shared, alone };

  /// What stands in the file.
  struct Note {
    bool is_open = false;          ///< whoever was last has not closed it
    std::vector<FileMark> mended;  ///< files in whose place others are now
    std::int64_t said_at = 0;      ///< [s since 1970]
    std::string said;              ///< what happened to the database then
  };

  /// @param database  beside which it lies. Error: its folder is not there, or nobody may write there
  [[nodiscard]] static Result<StoreLock> open(const std::filesystem::path& database);
  StoreLock(StoreLock&& other) noexcept;
  StoreLock& operator=(StoreLock&& other) noexcept;
  ~StoreLock();

  void wait_for(Part part, Kind kind) const;
  [[nodiscard]] bool try_for(Part part, Kind kind) const;
  void release(Part part) const;

  [[nodiscard]] Note note() const;
  [[nodiscard]] Result<void> write(const Note& note) const;  ///< while one has `files` alone

 private:
  explicit StoreLock(int file) : file_{file} {}
  int file_;
};

}  // namespace docent::telepresence
