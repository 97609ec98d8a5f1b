#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace docent::localization {

/// A folder in which range tables wait for the next run: making one takes from a second for a museum to a minute or two
/// for a building of 200 x 200 m. Processes may share it; whatever lies in it, only the time of a start depends on it.
struct RangeTableCache {
  std::filesystem::path folder;  ///< exists; empty: nothing is kept
  /// [bytes] of all tables together; the one in use stays, however large. A museum's has 5 to 30 MB and a building of
  /// 200 x 200 m has 300 MB: this holds some of the largest and is little beside a disk.
  std::uint64_t most_bytes = 2'000'000'000;

  /// What part of a file's name tells that it is not whole yet.
  static constexpr const char* kPart = ".part";

  /// Where the table of `key` lies, which names all that it depends on.
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;
  /// Removes the tables that were not used for the longest time until the rest has room, all but `in_use`, and what a
  /// process left half written more than an hour ago. What cannot be removed stays.
  void make_room(const std::filesystem::path& in_use) const;
};

}  // namespace docent::localization
