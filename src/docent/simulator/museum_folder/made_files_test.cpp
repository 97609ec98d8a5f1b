#include "docent/simulator/museum_folder/made_files.h"

#include <gtest/gtest.h>

#include "docent/base/files.h"

namespace docent::simulator {
namespace {

namespace fs = std::filesystem;

class MadeFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path{testing::TempDir()} / "made-files";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file_atomically(folder_ / name, text).has_value());
  }
  [[nodiscard]] Result<void> check(const std::vector<std::string>& names) const {
    const auto made = MadeFiles::in(folder_);
    return made ? made->check(names) : tl::unexpected<Error>(made.error());
  }
  fs::path folder_;
};

TEST_F(MadeFilesTest, WhatWasMadeMayBeMadeAnew) {
  EXPECT_TRUE(check({"a", "b"}).has_value()) << "nothing is there";
  write("a", "one");
  ASSERT_TRUE(MadeFiles::in(folder_)->note({"a"}).has_value());
  EXPECT_TRUE(check({"a", "b"}).has_value());
}

TEST_F(MadeFilesTest, WhatAPersonEditedIsKept) {
  write("a", "one");
  ASSERT_TRUE(MadeFiles::in(folder_)->note({"a"}).has_value());
  write("a", "my own words");
  const auto checked = check({"a"});
  ASSERT_FALSE(checked.has_value());
  EXPECT_NE(checked.error().message.find("a: was edited"), std::string::npos) << checked.error().message;
}

TEST_F(MadeFilesTest, WhatAPersonWroteIsKept) {
  write("museum.yaml", "by hand");
  const auto checked = check({"museum.yaml"});
  ASSERT_FALSE(checked.has_value());
  EXPECT_NE(checked.error().message.find("was not made"), std::string::npos) << checked.error().message;
}

}  // namespace
}  // namespace docent::simulator
