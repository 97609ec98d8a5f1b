#include "docent/telepresence/store/salvage/recovery.h"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "docent/base/files.h"
#include "docent/telepresence/store/salvage/page_images.h"
#include "docent/telepresence/store/salvage/statement.h"
#include "docent/telepresence/store/salvage/table_copy.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPage = 4096;
constexpr int kRows = 400;

/// A database of some pages, whose newest rows are in the WAL alone, as if its program had been killed.
class ADamagedStore : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/docent-salvage-XXXXXX";
    folder_ = ::mkdtemp(name);
    sqlite3_open((folder_ / "web.sqlite").c_str(), &database_);
    sqlite3_db_config(database_, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
    run("PRAGMA journal_mode = WAL");
    run("CREATE TABLE posts (id TEXT PRIMARY KEY, text TEXT NOT NULL, written BIGINT NOT NULL)");
    run("CREATE TABLE accounts (name TEXT PRIMARY KEY, hash TEXT NOT NULL, rank TEXT NOT NULL, created BIGINT NOT "
        "NULL)");
    run("INSERT INTO accounts VALUES ('ada', 'hash of ada', 'operator', 7)");
    add(0, kRows / 2);
    run("PRAGMA wal_checkpoint(TRUNCATE)");
    add(kRows / 2, kRows);
    take();
  }
  void TearDown() override {
    sqlite3_close(database_);
    fs::remove_all(folder_);
  }
  void run(const std::string& text) const {
    ASSERT_EQ(sqlite3_exec(database_, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << text << ": " << sqlite3_errmsg(database_);
  }
  void add(int first, int last) const {
    for (int i = first; i < last; ++i)
      run("INSERT INTO posts VALUES ('p" + std::to_string(i) + "', '" +
          std::string(static_cast<std::size_t>(i % 90), 'x') + "', " + std::to_string(i * 1000) + ")");
  }
  void take() {
    left_.file = *read_file(folder_ / "web.sqlite");
    left_.wal = *read_file(folder_ / "web.sqlite-wal");
  }
  /// The posts that were recovered.
  std::set<std::string> recovered() {
    const fs::path to = folder_ / "new.sqlite";
    fs::remove(to);
    const auto done = recover(left_, to);
    EXPECT_TRUE(done) << done.error().message;
    if (!done) return {};
    done_ = *done;
    EXPECT_EQ(fault_of_database(to), "");
    std::set<std::string> posts;
    sqlite3* made = nullptr;
    sqlite3_open(to.c_str(), &made);
    {
      Statement rows{made, "SELECT id, text, written FROM posts"};
      while (rows.step()) {
        posts.insert(rows.text(0));
        const int number = std::atoi(rows.text(0).c_str() + 1);
        EXPECT_EQ(rows.value(2), Value{std::int64_t{number} * 1000});
        EXPECT_EQ(rows.text(1).size(), static_cast<std::size_t>(number % 90));
      }
      Statement accounts{made, "SELECT hash FROM accounts WHERE name = 'ada'"};
      account_ = accounts.step() ? accounts.text(0) : "";
    }
    sqlite3_close(made);
    return posts;
  }
  fs::path folder_;
  sqlite3* database_ = nullptr;
  Remains left_;
  Recovered done_;
  std::string account_;
};

TEST_F(ADamagedStore, IsWholeWhereNothingIsDamaged) {
  EXPECT_FALSE(look_at_wal(left_.wal).is_damaged);
  EXPECT_EQ(recovered().size(), kRows);
  EXPECT_EQ(account_, "hash of ada");
  EXPECT_EQ(done_.lost_pages, 0U);
}

TEST_F(ADamagedStore, KeepsWhatIsBehindAWrongByteOfTheWal) {
  for (const std::size_t at : {std::size_t{5}, std::size_t{17}, left_.wal.size() / 3, left_.wal.size() / 2}) {
    take();
    left_.wal[at] = static_cast<char>(left_.wal[at] ^ 0x55);
    EXPECT_TRUE(look_at_wal(left_.wal).is_damaged) << at;
    EXPECT_GE(recovered().size(), kRows - 1U) << at;
  }
}

TEST_F(ADamagedStore, KeepsAllOtherPagesWhereOneIsGone) {
  run("PRAGMA wal_checkpoint(TRUNCATE)");
  take();
  left_.wal.clear();
  const std::size_t pages = left_.file.size() / kPage;
  ASSERT_GT(pages, 8U);
  std::size_t fewest = kRows;
  for (std::size_t page = 1; page < pages; ++page) {
    take();
    std::fill_n(left_.file.begin() + static_cast<std::ptrdiff_t>(page * kPage), kPage, '\0');
    fewest = std::min(fewest, recovered().size());
  }
  EXPECT_GT(fewest, kRows - 120U) << "a leaf holds so many";
  EXPECT_LT(fewest, kRows) << "or the test spoils nothing";
}

TEST_F(ADamagedStore, FindsTheRowsOfAPageWhoseHeaderIsSpoiled) {
  run("PRAGMA wal_checkpoint(TRUNCATE)");
  take();
  left_.wal.clear();
  for (std::size_t page = 1; page < left_.file.size() / kPage; ++page)
    for (std::size_t at = 0; at < 12; ++at) left_.file[page * kPage + at] = '\x7f';
  EXPECT_EQ(recovered().size(), kRows) << "no tree is left at all";
  EXPECT_EQ(account_, "hash of ada");
}

TEST_F(ADamagedStore, TakesItsTablesFromABackupWhereTheFirstPageIsGone) {
  run("VACUUM INTO '" + (folder_ / "backup.sqlite").string() + "'");
  run("PRAGMA wal_checkpoint(TRUNCATE)");
  take();
  left_.wal.clear();
  std::fill_n(left_.file.begin(), kPage, '\0');
  left_.backup = folder_ / "backup.sqlite";
  EXPECT_EQ(recovered().size(), kRows);
  left_.file.clear();
  EXPECT_EQ(recovered().size(), kRows) << "nothing is left, and the backup has it";
  EXPECT_EQ(done_.from_backup, kRows + 1U);
}

TEST_F(ADamagedStore, HasItsAccountsFromTheirCopy) {
  ASSERT_TRUE(TableCopy::of(database_)->write(folder_ / "accounts"));
  left_.copy = folder_ / "accounts";
  left_.file.clear();
  left_.wal.clear();
  const fs::path to = folder_ / "new.sqlite";
  const auto done = recover(left_, to);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(done->from_copy, 1);
  struct stat made {};
  ASSERT_EQ(::stat(to.c_str(), &made), 0);
  EXPECT_EQ(made.st_mode & 0777U, 0600U);
}

TEST_F(ADamagedStore, DoesNotBringBackWhatWasDeleted) {
  run("DELETE FROM posts WHERE written % 2000 = 0");
  run("PRAGMA wal_checkpoint(TRUNCATE)");
  take();
  left_.wal.clear();
  for (std::size_t page = 1; page < left_.file.size() / kPage; ++page) left_.file[page * kPage] = '\x7f';
  EXPECT_EQ(recovered().size(), kRows / 2);
}

TEST_F(ADamagedStore, IsReadWhateverItsBytesAre) {
  unsigned seed = 1;
  const auto draw = [&](std::size_t below) {
    seed = seed * 1664525U + 1013904223U;
    return (seed >> 8U) % below;
  };
  std::size_t rows = 0;
  for (int i = 0; i < 25; ++i) {
    take();
    for (int k = 0; k < 60; ++k) {
      left_.file[draw(left_.file.size())] = static_cast<char>(draw(256));
      left_.wal[draw(left_.wal.size())] = static_cast<char>(draw(256));
    }
    const fs::path to = folder_ / "new.sqlite";
    fs::remove(to);
    if (const auto done = recover(left_, to)) rows += done->rows;
  }
  EXPECT_GT(rows, 25U * kRows / 2);
}

TEST(ATableCopy, IsReadAsItWasWrittenOrNotAtAll) {
  char name[] = "/tmp/docent-copy-XXXXXX";
  const fs::path folder = ::mkdtemp(name);
  const TableCopy copy{{"name", "hash"},
                       {{std::string{"ada"}, std::string{"h:1\n2"}}, {std::string{"bo"}, std::int64_t{-7}}}};
  ASSERT_TRUE(copy.write(folder / "copy"));
  EXPECT_EQ(TableCopy::read(folder / "copy"), copy);
  const std::string whole = *read_file(folder / "copy");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string spoiled = whole;
    spoiled[at] = static_cast<char>(spoiled[at] ^ 1);
    std::ofstream{folder / "copy", std::ios::binary} << spoiled;
    EXPECT_FALSE(TableCopy::read(folder / "copy")) << at;
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace docent::telepresence
