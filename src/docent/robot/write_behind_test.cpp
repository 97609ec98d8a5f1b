#include "docent/robot/write_behind.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "docent/base/files.h"

namespace docent::robot {
namespace {

class WriteBehindTest : public testing::Test {
 protected:
  WriteBehindTest() { std::filesystem::create_directories(folder_); }
  ~WriteBehindTest() override { std::filesystem::remove_all(folder_); }
  const std::filesystem::path folder_{testing::TempDir() + "/write-behind-" + std::to_string(::getpid())};
};

TEST_F(WriteBehindTest, AllIsWrittenBeforeTheEnd) {
  {
    WriteBehind writer;
    for (int i = 0; i <= 100; ++i) writer.write(folder_ / "a", std::to_string(i));
    writer.write(folder_ / "b", "other");
  }
  EXPECT_EQ(read_file(folder_ / "a").value(), "100") << "the newest";
  EXPECT_EQ(read_file(folder_ / "b").value(), "other");
}

TEST_F(WriteBehindTest, SaysWhatCannotBeWrittenUntilItCan) {
  WriteBehind writer;
  const auto settle = [&](bool with_fault) {
    for (int i = 0; i < 1000 && writer.fault().empty() == with_fault; ++i) ::usleep(5000);
  };
  writer.write(folder_ / "none" / "a", "1");
  settle(true);
  EXPECT_NE(writer.fault().find("none/a"), std::string::npos) << writer.fault();
  writer.write(folder_ / "b", "2");
  std::filesystem::create_directories(folder_ / "none");
  writer.write(folder_ / "none" / "a", "3");
  settle(false);
  EXPECT_EQ(writer.fault(), "");
  EXPECT_EQ(read_file(folder_ / "none" / "a").value(), "3");
}

}  // namespace
}  // namespace docent::robot
