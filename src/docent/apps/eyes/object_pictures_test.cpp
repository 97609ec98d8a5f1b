#include "docent/apps/eyes/object_pictures.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "docent/base/files.h"
#include "docent/pictures/jpeg/jpeg.h"

namespace docent::apps::objects_command {
namespace {

namespace fs = std::filesystem;

class ObjectPicturesTest : public ::testing::Test {
 protected:
  ObjectPicturesTest() { fs::create_directories(folder_ / "can"); }
  ~ObjectPicturesTest() override { fs::remove_all(folder_); }
  void put(const fs::path& name, const pictures::Image& picture) const {
    const auto file = pictures::encode_jpeg(picture, 80);
    ASSERT_TRUE(write_file_atomically(folder_ / name, {reinterpret_cast<const char*>(file.data()), file.size()}));
  }
  fs::path folder_ = fs::path{testing::TempDir()} / ("object-pictures-" + std::to_string(::getpid()));
};

TEST_F(ObjectPicturesTest, TakesPicturesOfTelephonesAndNoLeftoversOfOtherSystems) {
  put("can/IMG_1.JPG", pictures::Image{5000, 64});
  put("can/b.jpeg", pictures::Image{64, 64});
  ASSERT_TRUE(write_file_atomically(folder_ / "can" / "._b.jpeg", "no picture"));
  ASSERT_TRUE(write_file_atomically(folder_ / "can" / "notes.txt", "no picture"));
  const auto folders = object_folders(folder_);
  ASSERT_TRUE(folders) << folders.error().message;
  ASSERT_EQ(folders->size(), 1U);
  EXPECT_EQ(folders->front().object, "can");
  ASSERT_EQ(folders->front().pictures.size(), 2U);
  for (const fs::path& path : folders->front().pictures) EXPECT_TRUE(read_picture(path)) << path;
}

TEST_F(ObjectPicturesTest, NamesTheFileThatIsNoPicture) {
  put("can/small.jpg", pictures::Image{20, 400});
  ASSERT_TRUE(write_file_atomically(folder_ / "can" / "text.jpg", "no picture"));
  for (const char* name : {"small.jpg", "text.jpg"}) {
    const auto picture = read_picture(folder_ / "can" / name);
    ASSERT_FALSE(picture) << name;
    EXPECT_EQ(picture.error().message.rfind((folder_ / "can" / name).string() + ": ", 0), 0U)
        << picture.error().message;
  }
}

}  // namespace
}  // namespace docent::apps::objects_command
