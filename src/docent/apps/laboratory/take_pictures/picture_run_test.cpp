#include "docent/apps/laboratory/take_pictures/picture_run.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/apps/laboratory/take_pictures/drawn_hall.h"
#include "docent/apps/shared/temporary_folder.h"
#include "docent/base/files.h"

namespace docent::apps::take_pictures_command {
namespace {

TEST(PictureRun, WritesPicturesWithWhatIsToldAndWhatIsTrue) {
  const simulator::World world = drawn_hall({.length = 10.0, .width = 8.0, .opening = 5.0});
  DriveOptions options;
  options.pictures = 3;
  const auto drive = drive_everywhere(world, options, Rng{1});
  ASSERT_TRUE(drive);
  PictureRunOptions run;
  run.eyes.rig = {.width = 64, .height = 48};
  const auto write = [&](const std::filesystem::path& folder) {
    std::size_t count = 0;
    const auto done = take_pictures(world, *drive, run, folder, [&](std::size_t now) { count = now; });
    EXPECT_TRUE(done) << done.error().message;
    EXPECT_EQ(count, 3U);
  };
  const TemporaryFolder first, again;
  write(first.path());
  write(again.path());
  for (const char* name : {"up/000000.png", "front/000002.png", "depth/000001.png", "poses.csv", "cameras.yaml",
                           "truth/poses.csv", "truth/cameras.yaml", "truth/ceiling.csv"}) {
    const auto file = read_file(first.path() / name);
    ASSERT_TRUE(file) << name;
    EXPECT_GT(file->size(), 50U) << name;
    EXPECT_EQ(*file, *read_file(again.path() / name)) << name << ": a seed gives the same";
  }
  const std::string poses = *read_file(first.path() / "poses.csv");
  EXPECT_EQ(std::count(poses.begin(), poses.end(), '\n'), 4);
  EXPECT_NE(read_file(first.path() / "truth/ceiling.csv")->find(",8.5000"), std::string::npos) << "the opening";
}

}  // namespace
}  // namespace docent::apps::take_pictures_command
