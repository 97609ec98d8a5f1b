#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "docent/base/result.h"

namespace docent::telepresence {

/// The files of one database: FILE, FILE-wal, FILE-shm, and beside them FILE.lock, FILE.accounts and backups/.
class SqliteFiles {
 public:
  explicit SqliteFiles(std::filesystem::path file) : file_{std::move(file)} {}

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] std::filesystem::path wal() const { return file_.string() + "-wal"; }
  [[nodiscard]] std::filesystem::path index() const { return file_.string() + "-shm"; }
  [[nodiscard]] std::filesystem::path accounts() const { return file_.string() + ".accounts"; }
  /// As they will be when what is being committed is.
  [[nodiscard]] std::filesystem::path next_accounts() const { return file_.string() + ".accounts.next"; }
  [[nodiscard]] std::filesystem::path backups() const { return file_.parent_path() / "backups"; }
  [[nodiscard]] std::filesystem::path newest_backup() const;  ///< of this database; empty: there is none

  static constexpr const char* kWalGone = "the WAL is gone: what was stored last may be lost";
  static constexpr const char* kWalCut = "the WAL is cut off";

  /// What SQLite would not notice, or would answer by losing what is there: "" where nothing is wrong. While nobody has
  /// the database open.
  /// @param was_left_open  whoever had it open before has not closed it
  [[nodiscard]] std::string fault(bool was_left_open) const;
  /// What is in file and WAL. While nobody has the database open: SQLite's locks are of the process.
  struct Bytes {
    std::string file, wal;
  };
  [[nodiscard]] Bytes read() const;

  /// Puts a new database of what is left in the place of this one, which stays as FILE.damaged-TIME with its WAL.
  /// @param note  is called before the first file is moved. @returns what happened, in a sentence
  [[nodiscard]] Result<std::string> mend(const Bytes& left, const std::string& why,
                                         const std::function<Result<void>()>& note) const;
  /// Ends what a program that was killed has begun.
  void finish_mending() const;
  void make_private() const;

 private:
  [[nodiscard]] std::filesystem::path mended() const { return file_.string() + ".mended"; }
  Result<void> put_mended(const std::filesystem::path& aside) const;

  std::filesystem::path file_;
};

}  // namespace docent::telepresence
