#include "docent/base/shipped_files.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <string>

namespace docent {
namespace {

namespace fs = std::filesystem;

class ShippedFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "docent-shipped-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    top_ = pattern;
    fs::create_directories(top_ / "sources/museums/bonn");
    fs::create_directories(top_ / "prefix/bin");
  }
  void TearDown() override { fs::remove_all(top_); }

  fs::path top_;
};

TEST_F(ShippedFiles, LieBesideTheInstalledProgramAndMoveWithIt) {
  fs::create_directories(top_ / "prefix/share/docent/museums/bonn");
  EXPECT_EQ(shipped_path("museums/bonn", top_ / "prefix/bin/docent", top_ / "sources"),
            top_ / "prefix/share/docent/museums/bonn");
  fs::rename(top_ / "prefix", top_ / "moved");
  EXPECT_EQ(shipped_path("museums/bonn", top_ / "moved/bin/docent", top_ / "sources"),
            top_ / "moved/share/docent/museums/bonn");
}

TEST_F(ShippedFiles, LieInTheSourcesWhereNothingIsInstalled) {
  EXPECT_EQ(shipped_path("museums/bonn", top_ / "prefix/bin/docent", top_ / "sources"), top_ / "sources/museums/bonn");
  // Other things that are installed say nothing about this one.
  fs::create_directories(top_ / "prefix/share/docent/web/dist");
  EXPECT_EQ(shipped_path("museums/bonn", top_ / "prefix/bin/docent", top_ / "sources"), top_ / "sources/museums/bonn");
}

TEST_F(ShippedFiles, AreFoundFromTheBuildTree) {
  EXPECT_TRUE(fs::is_regular_file(program_path())) << program_path();
  EXPECT_TRUE(fs::exists(shipped_path("museums/bonn/museum.yaml"))) << shipped_path("museums/bonn/museum.yaml");
}

}  // namespace
}  // namespace docent
