#include "docent/vision/ceiling/drive/ceiling_drive.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "docent/base/files.h"
#include "docent/pictures/png/png_file.h"

namespace docent::vision::ceiling_drive_test {
namespace {

constexpr const char* kCameras =
    "up:\n  model: brown\n  width: 8\n  height: 6\n  focal: [5, 5]\n  centre: [4, 3]\n"
    "  distortion: [0, 0, 0, 0, 0]\n  mount: {x: 0.1, y: 0.02, z: 1.25, pan: 0, tilt: 90, roll: 0}\n"
    "front: {model: unread}\n";
constexpr const char* kPoses =
    "picture,time,map_theta,map_x,map_y\n000003,0.0,0.5,1.5,2.5\n000007,0.5,-0.5,1.75,2.25\n";

class CeilingDriveTest : public ::testing::Test {
 protected:
  CeilingDriveTest() { std::filesystem::create_directories(folder_); }
  ~CeilingDriveTest() override { std::filesystem::remove_all(folder_); }
  void put(const char* name, std::string_view content) const {
    ASSERT_TRUE(write_file_atomically(folder_ / name, content));
  }
  void put_whole() const {
    std::filesystem::create_directories(folder_ / "up");
    put("cameras.yaml", kCameras);
    put("poses.csv", kPoses);
    std::vector<std::uint8_t> grey(48, 100);
    grey[0] = 7;
    for (const char* name : {"up/000003.png", "up/000007.png"})
      put(name, *pictures::encode_png(8, 6, std::span<const std::uint8_t>{grey}));
  }
  [[nodiscard]] std::string fault() const {
    const auto drive = read_ceiling_drive(folder_);
    if (drive) return "";
    const std::string& message = drive.error().message;
    EXPECT_EQ(message.rfind(folder_.string() + "/", 0), 0U) << message;
    return message.substr(folder_.string().size() + 1);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("docent_ceiling_drive_" + std::to_string(getpid()));
};

TEST_F(CeilingDriveTest, ReadsPicturesPosesAndTheCamera) {
  put_whole();
  const auto drive = read_ceiling_drive(folder_);
  ASSERT_TRUE(drive) << drive.error().message;
  EXPECT_EQ(drive->numbers, (std::vector<int>{3, 7}));
  EXPECT_EQ(drive->map_from_robot[1].x, 1.75);
  EXPECT_EQ(drive->map_from_robot[1].y, 2.25);
  EXPECT_NEAR(drive->map_from_robot[1].theta.radians(), -0.5, 1e-12);
  ASSERT_EQ(drive->placed().size(), 2U);
  EXPECT_EQ(drive->placed()[0].picture.bytes[0], 7);
  // Straight above the lens is the picture's middle, counted from its corner; what lies ahead is lower in the picture.
  const auto above = drive->camera.pixel_of({0.1, 0.02}, 3.0), ahead = drive->camera.pixel_of({0.3, 0.02}, 3.0),
             left = drive->camera.pixel_of({0.1, 0.22}, 3.0);
  ASSERT_TRUE(above && ahead && left);
  EXPECT_NEAR(above->x(), 3.5, 1e-9);
  EXPECT_NEAR(above->y(), 2.5, 1e-9);
  EXPECT_NEAR(ahead->y() - above->y(), 5.0 * 0.2 / 1.75, 1e-9);
  EXPECT_NEAR(left->x() - above->x(), -5.0 * 0.2 / 1.75, 1e-9);
}

TEST_F(CeilingDriveTest, ReadsOdometryWhereThereIsSome) {
  put_whole();
  EXPECT_FALSE(read_ceiling_drive(folder_)->placed()[1].odom_from_robot);
  put("poses.csv",
      "picture,odometry_x,odometry_y,odometry_theta,map_x,map_y,map_theta\n3,0,0,0,1,2,0\n7,0.5,0.25,1,1,2,0\n");
  const auto placed = read_ceiling_drive(folder_);
  ASSERT_TRUE(placed) << placed.error().message;
  EXPECT_EQ(placed->odom_from_robot[1].y, 0.25);
  EXPECT_EQ(placed->map_from_robot[1].y, 2.0);
}

TEST_F(CeilingDriveTest, NamesFileAndLineOfWhatCannotBe) {
  put_whole();
  put("poses.csv", "picture,map_x,map_y\n");
  EXPECT_EQ(fault(), "poses.csv:1: has no column 'map_theta'");
  put("poses.csv", "picture,map_x,map_y,map_theta\n3,1,2,0\n7,1,two,0\n");
  EXPECT_EQ(fault(), "poses.csv:3: expected a number under 'map_y'");
  put("poses.csv", "picture,map_x,map_y,map_theta\n3,1\n");
  EXPECT_EQ(fault().rfind("poses.csv:2: ", 0), 0U) << fault();
  put("poses.csv", "picture,map_x,map_y,map_theta\n");
  EXPECT_EQ(fault().rfind("poses.csv:1: ", 0), 0U) << fault();
  put("poses.csv", kPoses);
  put("up/000007.png", *pictures::encode_png(4, 4, std::span<const std::uint8_t>{std::vector<std::uint8_t>(16)}));
  EXPECT_EQ(fault(), "up/000007.png:1: is 4 x 4 pixels, but the lens is said to have 8 x 6");
  std::filesystem::remove(folder_ / "up/000007.png");
  EXPECT_EQ(fault().rfind("up/000007.png", 0), 0U) << fault();
  std::string cameras = kCameras;
  cameras.replace(cameras.find("tilt: 90"), 8, "tilt: 10");
  put("cameras.yaml", cameras);
  EXPECT_NE(fault().find("cameras.yaml:8: this camera does not look up"), std::string::npos) << fault();
  put("cameras.yaml", "front: {}\n");
  EXPECT_EQ(fault(), "cameras.yaml:1: has no camera 'up'");
}

}  // namespace
}  // namespace docent::vision::ceiling_drive_test
