#include "docent/pictures/image.h"

#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include "docent/base/files.h"

namespace docent {
namespace {

TEST(Image, BlendsByAlphaAndCoverage) {
  Image image{3, 2, colors::kWhite};
  image.blend(1, 1, colors::kBlack, 0.5);
  image.blend(2, 1, with_alpha(colors::kBlack, 51));
  image.blend(3, 1, colors::kBlack);  // outside: nothing happens
  image.blend(-1, 0, colors::kBlack);
  EXPECT_EQ(image.at(0, 0), colors::kWhite);
  EXPECT_EQ(image.at(1, 1), (Color{128, 128, 128}));
  EXPECT_EQ(image.at(2, 1), (Color{204, 204, 204}));
}

TEST(Image, BlendsOntoClearPixelsWithoutADarkRim) {
  Image image{1, 1, Color{0, 0, 0, 0}};
  image.blend(0, 0, colors::kRed, 0.25);
  EXPECT_EQ(image.at(0, 0), with_alpha(colors::kRed, 64));
}

TEST(Image, PngKeepsEveryPixel) {
  Image image{17, 5, colors::kFloor};
  image.set(16, 4, Color{1, 2, 3, 77});
  const auto path = std::filesystem::temp_directory_path() / ("docent_image_" + std::to_string(getpid()) + ".png");
  ASSERT_TRUE(save_png(image, path));
  const auto bytes = read_file(path);
  ASSERT_TRUE(bytes);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&header, bytes->data(), bytes->size()), 0);
  header.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(header));
  ASSERT_NE(png_image_finish_read(&header, nullptr, read.data(), 0, nullptr), 0);
  EXPECT_EQ(read, std::vector<std::uint8_t>(image.bytes().begin(), image.bytes().end()));
  std::filesystem::remove(path);
}

TEST(Image, RefusesAFolderThatIsNotThere) {
  const auto saved = save_png(Image{1, 1}, "/nowhere/at/all.png");
  ASSERT_FALSE(saved);
  EXPECT_NE(saved.error().message.find("/nowhere/at/all.png"), std::string::npos);
}

TEST(Colors, MapsAreMonotoneInDarkness) {
  const auto light = [](Color c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; };
  for (int i = 0; i < 100; ++i) EXPECT_GT(light(heat(i / 100.0)), light(heat((i + 1) / 100.0))) << i;
  EXPECT_EQ(heat(-1.0), heat(0.0));
  EXPECT_EQ(heat(2.0), heat(1.0));
  EXPECT_EQ(distinct(0), distinct(8));
}

}  // namespace
}  // namespace docent
