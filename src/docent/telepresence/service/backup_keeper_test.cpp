#include "docent/telepresence/service/backup_keeper.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "docent/telepresence/store/database.h"

namespace docent::telepresence {
namespace {

constexpr std::int64_t kDay = 86400;

TEST(TheBackupKeeper, MakesOneADayAndSaysWhenItCannot) {
  char name[] = "/tmp/docent-backups-XXXXXX";
  const std::filesystem::path state = ::mkdtemp(name);
  const std::string file = (state / "web.sqlite").string();
  ASSERT_TRUE((*Database::open(file))->run_script("CREATE TABLE t (a BIGINT)"));
  const StoreBackups backups{state, file, ""};
  BackupKeeper keeper{backups};
  for (int i = 0; i < 5; ++i) {
    keeper.look(100 * kDay + i);
    keeper.finish();
  }
  EXPECT_EQ(backups.list().size(), 1U);
  EXPECT_EQ(keeper.fault(), "");
  keeper.look(101 * kDay);
  keeper.finish();
  EXPECT_EQ(backups.list().size(), 2U);
  std::filesystem::remove_all(backups.folder());
  std::ofstream{backups.folder()} << "no folder";
  keeper.look(102 * kDay);
  keeper.finish();
  EXPECT_NE(keeper.fault(), "");
  std::filesystem::remove(backups.folder());
  keeper.look(102 * kDay + 60);
  keeper.finish();
  EXPECT_NE(keeper.fault(), "") << "not at once";
  keeper.look(102 * kDay + 3601);
  keeper.finish();
  EXPECT_EQ(keeper.fault(), "");
  std::filesystem::remove_all(state);
}

}  // namespace
}  // namespace docent::telepresence
