#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"

namespace docent::telepresence {

/// Copies of accounts, forum and counts, and of the museum, below STATE/backups: a folder a day, named 20261129 and
/// holding FILE (such as web.sqlite) and museum/. A folder that has its name is whole.
class StoreBackups {
 public:
  static constexpr std::size_t kKept = 7;

  /// @param database  "postgresql://…": then the museum alone is copied; its own programs copy a server
  /// @param museum    the folder of the museum; empty: none is copied
  StoreBackups(std::filesystem::path state, std::string database, std::filesystem::path museum)
      : state_{std::move(state)}, database_{std::move(database)}, museum_{std::move(museum)} {}

  [[nodiscard]] std::filesystem::path folder() const { return state_ / "backups"; }
  [[nodiscard]] std::vector<std::filesystem::path> list() const;  ///< the oldest first
  [[nodiscard]] bool is_due(std::int64_t now_s) const;            ///< there is none of this day (UTC)
  /// Makes one, into a folder of its own, and forgets all but the newest `kKept`. @returns the folder
  [[nodiscard]] Result<std::filesystem::path> make(std::int64_t now_s) const;
  /// Into that folder, which must not be there yet.
  [[nodiscard]] Result<void> make_in(const std::filesystem::path& folder) const;

  /// Puts a backup's database in the place of the one in `state`, which stays as FILE.replaced-TIME.
  /// Error: the database is open, as while a robot runs; the backup is damaged; nothing has changed then.
  /// @returns what was kept; empty: there was none
  [[nodiscard]] static Result<std::filesystem::path> restore_database(const std::filesystem::path& backup,
                                                                      const std::filesystem::path& database);
  /// Likewise a museum's folder.
  [[nodiscard]] static Result<std::filesystem::path> restore_museum(const std::filesystem::path& backup,
                                                                    const std::filesystem::path& museum);

 private:
  std::filesystem::path state_;
  std::string database_;
  std::filesystem::path museum_;
};

}  // namespace docent::telepresence
