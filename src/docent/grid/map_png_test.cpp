#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "docent/base/random.h"
#include "docent/grid/map_image.h"

namespace docent {
namespace {

struct Form {
  int depth = 8;
  int colour = PNG_COLOR_TYPE_GRAY;
  bool has_gamma = false;
  int interlace = PNG_INTERLACE_NONE;
};

/// Writes one image of `rows` whose samples are the file's own bytes.
void write_png(const std::filesystem::path& path, int width, const Form& form,
               std::vector<std::vector<unsigned char>> rows) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()), form.depth,
               form.colour, form.interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (form.has_gamma) png_set_gAMA(png, info, 1.0);
  const png_color palette[] = {{0, 0, 0}, {205, 205, 205}, {254, 254, 254}};
  if (form.colour == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette, 3);
  std::vector<png_bytep> pointers;
  for (auto& row : rows) pointers.push_back(row.data());
  png_write_info(png, info);
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  std::fclose(file);
}

class MapPng : public ::testing::Test {
 protected:
  /// The shades of the first row, of 1000.
  std::vector<long> row_of(int width, const Form& form, const std::vector<std::vector<unsigned char>>& rows) {
    write_png(path_, width, form, rows);
    const auto image = open_png(path_);
    EXPECT_TRUE(image) << image.error().message;
    if (!image) return {};
    std::vector<std::uint32_t> shades;
    EXPECT_TRUE((*image)->read_row(shades));
    std::vector<long> of;
    for (const auto shade : shades)
      of.push_back(shade == MapImage::kClear ? -1 : std::lround(1000.0 * shade / (*image)->white()));
    return of;
  }
  void TearDown() override { std::filesystem::remove(path_); }
  std::filesystem::path path_ = std::filesystem::path{::testing::TempDir()} / "docent_map_png_test.png";
};

TEST_F(MapPng, AShadeIsAShareOfWhiteWhateverTheDepthAndTheGamma) {
  const std::vector<long> right{0, 804, 996};
  EXPECT_EQ(row_of(3, {}, {{0, 205, 254}}), right);
  EXPECT_EQ(row_of(3, {.has_gamma = true}, {{0, 205, 254}}), right);
  EXPECT_EQ(row_of(3, {.depth = 16}, {{0, 0, 205, 205, 254, 254}}), right);
  EXPECT_EQ(row_of(3, {.depth = 16, .has_gamma = true}, {{0, 0, 205, 205, 254, 254}}), right);
  EXPECT_EQ(row_of(3, {.colour = PNG_COLOR_TYPE_PALETTE}, {{0, 1, 2}}), right);
  EXPECT_EQ(row_of(3, {.interlace = PNG_INTERLACE_ADAM7}, {{0, 205, 254}, {0, 0, 0}}), right);
  EXPECT_EQ(row_of(4, {.depth = 1}, {{0x50}}), (std::vector<long>{0, 1000, 0, 1000}));
  EXPECT_EQ(row_of(2, {.depth = 2}, {{0xc0}}), (std::vector<long>{1000, 0}));
}

TEST_F(MapPng, AColourIsTheMeanOfItsChannels) {
  EXPECT_EQ(row_of(2, {.colour = PNG_COLOR_TYPE_RGB}, {{0, 0, 255, 30, 60, 90}}), (std::vector<long>{333, 235}));
}

TEST_F(MapPng, WhatIsNotHalfOpaqueIsClear) {
  EXPECT_EQ(row_of(3, {.colour = PNG_COLOR_TYPE_GRAY_ALPHA}, {{0, 0, 255, 254, 255, 100}}),
            (std::vector<long>{-1, 1000, -1}));
}

TEST_F(MapPng, ATornImageIsNamed) {
  std::vector<unsigned char> row;
  Rng rng{1};
  for (int i = 0; i < 4000; ++i) row.push_back(static_cast<unsigned char>(rng.integer(0, 255)));
  write_png(path_, 4000, {}, {row, row});
  std::filesystem::resize_file(path_, 1500);
  const auto image = open_png(path_);
  ASSERT_TRUE(image);
  std::vector<std::uint32_t> shades;
  const auto read = (*image)->read_row(shades);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("damaged PNG image"), std::string::npos);
}

}  // namespace
}  // namespace docent
