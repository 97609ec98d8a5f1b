#include "docent/telepresence/store/sqlite_database.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "docent/base/files.h"
#include "docent/telepresence/store/store_backups.h"

// What becomes of its files, while it is open and while it is not.

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

class TheFilesOfAStore : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/docent-files-XXXXXX";
    base_ = ::mkdtemp(name);
    fs::create_directory(base_ / "state");
    file_ = base_ / "state" / "web.sqlite";
    open();
    ASSERT_TRUE(
        database_->run_script("CREATE TABLE t (a BIGINT NOT NULL, b TEXT NOT NULL);"
                              "CREATE TABLE accounts (name TEXT PRIMARY KEY, hash TEXT NOT NULL, rank TEXT NOT NULL, "
                              "created BIGINT NOT NULL);"
                              "INSERT INTO accounts VALUES ('ada', 'the hash of ada', 'operator', 1)"));
    for (int i = 0; i < 300; ++i) ASSERT_TRUE(put(i));
  }
  void TearDown() override {
    database_.reset();
    fs::remove_all(base_);
  }
  void open() {
    auto opened = open_sqlite(file_);
    ASSERT_TRUE(opened) << opened.error().message;
    database_ = std::move(*opened);
  }
  [[nodiscard]] Result<void> put(std::int64_t number) const {
    return done(database_->run("INSERT INTO t (a, b) VALUES ($1, $2)", {number, std::string(60, 'b')}));
  }
  [[nodiscard]] std::int64_t count() const {
    const auto rows = database_->run("SELECT count(*) FROM t");
    EXPECT_TRUE(rows) << rows.error().message;
    return rows ? rows->rows.at(0).number(0) : -1;
  }
  [[nodiscard]] std::string hash() const {
    const auto rows = database_->run("SELECT hash FROM accounts WHERE name = 'ada'");
    return rows && !rows->rows.empty() ? rows->rows[0].text(0) : "";
  }
  [[nodiscard]] int kept(const std::string& why) const {
    int found = 0;
    for (const auto& entry : fs::directory_iterator(file_.parent_path()))
      found += entry.path().filename().string().starts_with("web.sqlite." + why) ? 1 : 0;
    return found;
  }
  void spoil(const std::string& what, const std::string& with) const {
    std::string content = *read_file(file_);
    ASSERT_NE(content.find(what), std::string::npos);
    content.replace(content.find(what), with.size(), with);
    std::ofstream{file_, std::ios::binary} << content;
  }
  fs::path base_, file_;
  std::unique_ptr<Database> database_;
};

TEST_F(TheFilesOfAStore, AreForTheirOwnerAlone) {
  for (const char* end : {"", "-wal", "-shm", ".accounts", ".lock"}) {
    struct stat found {};
    ASSERT_EQ(::stat((file_.string() + end).c_str(), &found), 0) << end;
    EXPECT_EQ(found.st_mode & 0777U, 0600U) << end;
  }
}

TEST_F(TheFilesOfAStore, AreMadeAnewWhenTheirFolderIsRemovedAndNothingIsLost) {
  const auto other = *open_sqlite(file_);  // as a gateway has several
  fs::remove_all(file_.parent_path());
  ASSERT_TRUE(database_->look());
  EXPECT_TRUE(fs::exists(file_));
  EXPECT_EQ(count(), 300);
  EXPECT_EQ(hash(), "the hash of ada");
  EXPECT_NE(database_->notice().find("the file is gone"), std::string::npos) << database_->notice();
  ASSERT_TRUE(put(300));
  EXPECT_EQ(other->run("SELECT count(*) FROM t")->rows.at(0).number(0), 301) << "and it finds what is new";
  ASSERT_TRUE(other->run("INSERT INTO t (a, b) VALUES (301, 'x')"));
  EXPECT_EQ(count(), 302);
  EXPECT_EQ(other->notice(), database_->notice());
}

TEST_F(TheFilesOfAStore, TakeNothingIntoAFileThatIsGone) {
  // Within a transaction nothing is mended.
  const auto stored = database_->in_transaction([&]() -> Result<void> {
    if (auto first = put(300); !first) return first;
    fs::remove(file_);
    return {};
  });
  EXPECT_FALSE(stored);
  EXPECT_TRUE(put(301));
  EXPECT_EQ(count(), 301);
}

TEST_F(TheFilesOfAStore, OutliveThatTheirWalIsTakenAway) {
  fs::remove(file_.string() + "-wal");
  ASSERT_TRUE(put(300));
  EXPECT_EQ(count(), 301);
  EXPECT_NE(database_->notice().find("the WAL is gone"), std::string::npos);
  database_.reset();
  open();
  EXPECT_EQ(count(), 301);
}

TEST_F(TheFilesOfAStore, AreMendedWhenCutToNothingWhileOpen) {
  const StoreBackups backups{file_.parent_path(), file_, ""};
  ASSERT_TRUE(backups.make(0));
  ASSERT_TRUE(put(300));
  fs::resize_file(file_, 0);
  ASSERT_TRUE(database_->look());
  EXPECT_EQ(count(), 301) << "from the WAL, and from the backup";
  EXPECT_EQ(hash(), "the hash of ada");
  EXPECT_NE(database_->notice().find("the file is empty"), std::string::npos);
  EXPECT_GT(kept("damaged"), 1) << "the file, and its WAL";
}

TEST_F(TheFilesOfAStore, AreMendedWhenTheFirstPageIsSpoiled) {
  database_.reset();
  spoil("SQLite format 3", "nonsense");
  open();
  EXPECT_EQ(count(), 300);
  EXPECT_EQ(hash(), "the hash of ada");
  EXPECT_NE(database_->notice(), "");
  EXPECT_EQ(kept("damaged"), 1);
  database_.reset();
  open();
  EXPECT_NE(database_->notice(), "") << "for a day";
}

TEST_F(TheFilesOfAStore, GiveBackAnAccountWhosePasswordIsSpoiled) {
  database_.reset();
  spoil("the hash of ada", "the hush of");
  open();
  EXPECT_EQ(hash(), "the hash of ada");
  EXPECT_EQ(count(), 300);
  EXPECT_EQ(kept("damaged"), 0);
}

TEST_F(TheFilesOfAStore, TakeNoChangeForADamageThatWasCommittedAndNotYetCopied) {
  const std::string before = *read_file(file_.string() + ".accounts");
  ASSERT_TRUE(database_->in_transaction([&] { return done(database_->run("UPDATE accounts SET hash = 'another'")); }));
  database_.reset();
  std::filesystem::rename(file_.string() + ".accounts", file_.string() + ".accounts.next");
  std::ofstream{file_.string() + ".accounts", std::ios::binary} << before;
  open();
  EXPECT_EQ(hash(), "another");
  EXPECT_EQ(database_->notice(), "");
  EXPECT_NE(*read_file(file_.string() + ".accounts"), before);
}

TEST_F(TheFilesOfAStore, DoNotGiveBackAnAccountThatWasRemoved) {
  ASSERT_TRUE(database_->run("DELETE FROM accounts WHERE name = 'ada'"));
  database_.reset();
  spoil("SQLite format 3", "nonsense");
  open();
  EXPECT_EQ(hash(), "");
}

TEST_F(TheFilesOfAStore, KeepTheAccountsWhenAllElseIsGone) {
  database_.reset();
  fs::remove(file_);
  open();
  EXPECT_EQ(hash(), "the hash of ada");
  EXPECT_NE(database_->notice(), "");
}

TEST_F(TheFilesOfAStore, GoOnWithAMendingThatWasKilled) {
  database_.reset();
  fs::rename(file_, file_.string() + ".mended");
  std::ofstream{file_} << "damaged";
  open();
  EXPECT_EQ(count(), 300);
  EXPECT_EQ(kept("damaged"), 1);
}

TEST_F(TheFilesOfAStore, SayThatTheDiskIsFullAndGoOnWhenThereIsRoom) {
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = fs::file_size(file_.string() + "-wal");
  ::setrlimit(RLIMIT_FSIZE, &small);
  Result<void> stored;
  for (int i = 0; i < 2000 && stored; ++i) stored = put(1000);
  ::setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(stored);
  EXPECT_NE(stored.error().message.find("the disk is full"), std::string::npos) << stored.error().message;
  EXPECT_TRUE(put(1));
}

TEST_F(TheFilesOfAStore, CanBeReadByAProgramThatStartsOnAFullDisk) {
  ASSERT_TRUE(put(1000));
  // As a program leaves it that is killed: what was stored last is in the WAL alone.
  fs::create_directory(base_ / "killed");
  for (const char* end : {"", "-wal"})
    fs::copy(file_.string() + end, base_ / "killed" / ("web.sqlite" + std::string{end}));
  database_.reset();
  file_ = base_ / "killed" / "web.sqlite";
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit none = before;
  none.rlim_cur = 100;
  ::setrlimit(RLIMIT_FSIZE, &none);
  open();
  EXPECT_EQ(hash(), "the hash of ada");
  EXPECT_EQ(count(), 301);
  const Result<void> stored = put(1001);
  ::setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(stored);
  EXPECT_NE(stored.error().message.find("the disk is full"), std::string::npos) << stored.error().message;
  for (int i = 0; i < 100 && !put(1002); ++i) ::usleep(100'000);
  EXPECT_EQ(count(), 302) << "when there is room it is stored again";
}

}  // namespace
}  // namespace docent::telepresence
