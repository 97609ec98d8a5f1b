#include "docent/pictures/png/png_file.h"

#include <gtest/gtest.h>
#include <png.h>

#include <vector>

namespace docent::pictures {
namespace {

/// What libpng's simple reader makes of a file, which knows nothing of how it was written.
std::vector<std::uint8_t> read_back(const std::string& file, png_uint_32 format, int& width) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()), 0);
  image.format = format;
  width = static_cast<int>(image.width);
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr), 0);
  return bytes;
}

TEST(PngFile, HoldsGreyAndColoursWithoutLoss) {
  const std::vector<std::uint8_t> grey{0, 1, 2, 100, 254, 255};
  const auto file = encode_png(3, 2, grey);
  ASSERT_TRUE(file);
  int width = 0;
  EXPECT_EQ(read_back(*file, PNG_FORMAT_GRAY, width), grey);
  EXPECT_EQ(width, 3);
  Image image{2, 1};
  image.set(0, 0, {10, 20, 30});
  image.set(1, 0, {200, 0, 255});
  const auto colored = encode_png(image);
  ASSERT_TRUE(colored);
  EXPECT_EQ(read_back(*colored, PNG_FORMAT_RGB, width), (std::vector<std::uint8_t>{10, 20, 30, 200, 0, 255}));
}

TEST(PngFile, HoldsSixteenBits) {
  const std::vector<std::uint16_t> depths{0, 1, 255, 256, 5000, 65535};
  const auto file = encode_png(2, 3, depths);
  ASSERT_TRUE(file);
  EXPECT_EQ(static_cast<int>((*file)[24]), 16) << "bits of a sample, by the header";
  // The bytes as they lie in the file, by the full reader.
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  struct Source {
    const std::string* file;
    std::size_t at = 0;
  } source{&*file};
  png_set_read_fn(png, &source, [](png_structp reader, png_bytep into, std::size_t count) {
    auto* from = static_cast<Source*>(png_get_io_ptr(reader));
    from->file->copy(reinterpret_cast<char*>(into), count, from->at);
    from->at += count;
  });
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  const png_bytepp rows = png_get_rows(png, info);
  for (std::size_t i = 0; i < depths.size(); ++i)
    EXPECT_EQ(256 * rows[i / 2][2 * (i % 2)] + rows[i / 2][2 * (i % 2) + 1], depths[i]) << i;
  png_destroy_read_struct(&png, &info, nullptr);
}

}  // namespace
}  // namespace docent::pictures
