#include "docent/telepresence/store/store_backups.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <fstream>

#include "docent/base/files.h"
#include "docent/telepresence/store/database.h"

namespace docent::telepresence {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kDay = 86400;

class TheBackups : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/docent-backups-XXXXXX";
    base_ = ::mkdtemp(name);
    state_ = base_ / "state";
    museum_ = base_ / "museum";
    fs::create_directories(state_);
    fs::create_directories(museum_ / "pictures");
    std::ofstream{museum_ / "museum.yaml"} << "name: old";
    std::ofstream{museum_ / "pictures" / "a.png"} << "a";
    database_ = std::move(*Database::open(file()));
    ASSERT_TRUE(database_->run_script("CREATE TABLE t (a BIGINT); INSERT INTO t VALUES (1)"));
  }
  void TearDown() override {
    database_.reset();
    fs::remove_all(base_);
  }
  [[nodiscard]] std::string file() const { return (state_ / "web.sqlite").string(); }
  [[nodiscard]] StoreBackups backups() const { return {state_, file(), museum_}; }
  [[nodiscard]] std::int64_t count() const {
    return (*Database::open(file()))->run("SELECT count(*) FROM t")->rows.at(0).number(0);
  }
  fs::path base_, state_, museum_;
  std::unique_ptr<Database> database_;
};

TEST_F(TheBackups, AreOneADayAndSeven) {
  for (int day = 0; day < 10; ++day) {
    EXPECT_TRUE(backups().is_due(day * kDay));
    ASSERT_TRUE(backups().make(day * kDay));
    EXPECT_FALSE(backups().is_due(day * kDay + 5));
  }
  const auto all = backups().list();
  ASSERT_EQ(all.size(), StoreBackups::kKept);
  EXPECT_EQ(all.front().filename(), "19700104");
  EXPECT_EQ(all.back().filename(), "19700110");
  struct stat found {};
  ASSERT_EQ(::stat((all.back() / "web.sqlite").c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777U, 0600U);
  EXPECT_EQ(*read_file(all.back() / "museum" / "pictures" / "a.png"), "a");
}

TEST_F(TheBackups, ArePutBackAndWhatWasThereIsKept) {
  const fs::path made = *backups().make(0);
  ASSERT_TRUE(database_->run("INSERT INTO t VALUES (2)"));
  std::ofstream{museum_ / "museum.yaml"} << "name: new";
  EXPECT_FALSE(StoreBackups::restore_database(made / "web.sqlite", file())) << "it is open";
  EXPECT_EQ(database_->run("SELECT count(*) FROM t")->rows.at(0).number(0), 2);
  database_.reset();
  const auto kept = StoreBackups::restore_database(made / "web.sqlite", file());
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_TRUE(fs::exists(*kept));
  EXPECT_EQ(count(), 1);
  EXPECT_EQ((*Database::open(file()))->notice(), "") << "that is no damage";
  const auto old = StoreBackups::restore_museum(made / "museum", museum_);
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_EQ(*read_file(museum_ / "museum.yaml"), "name: old");
  EXPECT_EQ(*read_file(*old / "museum.yaml"), "name: new");
}

TEST_F(TheBackups, ThatAreDamagedAreNotPutBack) {
  const fs::path made = *backups().make(0);
  std::ofstream{made / "web.sqlite"} << "nonsense";
  database_.reset();
  EXPECT_FALSE(StoreBackups::restore_database(made / "web.sqlite", file()));
  EXPECT_EQ(count(), 1);
  EXPECT_FALSE(StoreBackups::restore_database(made / "none", file()));
}

TEST_F(TheBackups, AreWholeOrNotThere) {
  EXPECT_FALSE(backups().make_in(state_)) << "there is something";
  const StoreBackups broken{state_, file(), base_ / "no-museum"};
  EXPECT_FALSE(broken.make_in(base_ / "copy"));
  EXPECT_FALSE(fs::exists(base_ / "copy"));
  for (const auto& entry : fs::directory_iterator(base_))
    EXPECT_FALSE(entry.path().filename().string().starts_with("."));
}

}  // namespace
}  // namespace docent::telepresence
