#include "docent/vision/ceiling/mosaic_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "docent/base/files.h"
#include "docent/pictures/png/png_file.h"

namespace docent::vision::mosaic_file_test {
namespace {

namespace fs = std::filesystem;

CeilingMosaic small_mosaic() {
  CeilingMosaic mosaic{{3, 2, 0.025, {-1.5, 2.125}}, {3.25, 18.5}, {}, {}};
  mosaic.part = {0, 1, CeilingMosaic::kUnknown, 0, 0, 1};
  mosaic.brightness = {0.0F, 0.25F, 0.0F, 1.2F, -0.1F, 0.5F};
  return mosaic;
}

class MosaicFileTest : public ::testing::Test {
 protected:
  MosaicFileTest() { fs::create_directories(folder_); }
  ~MosaicFileTest() override { fs::remove_all(folder_); }
  void put(const char* name, std::string_view content) const {
    ASSERT_TRUE(write_file_atomically(folder_ / name, content));
  }
  void put_whole() const { ASSERT_TRUE(write_ceiling(yaml_, small_mosaic())); }
  /// What reading says, after the folder's name.
  [[nodiscard]] std::string fault() const {
    const auto read = read_ceiling(yaml_);
    if (read) return "";
    const std::string& message = read.error().message;
    EXPECT_EQ(message.rfind(folder_.string() + "/", 0), 0U) << message;
    return message.substr(folder_.string().size() + 1);
  }
  /// The YAML with one line changed.
  void change(const std::string& key, const std::string& line) const {
    std::string text = read_file(yaml_).value();
    const std::size_t from = text.find(key + ":");
    ASSERT_NE(from, std::string::npos);
    text.replace(from, text.find('\n', from) - from, line);
    put("ceiling.yaml", text);
  }
  const fs::path folder_ = fs::path{testing::TempDir()} / ("mosaic-file-" + std::to_string(::getpid()));
  const fs::path yaml_ = folder_ / "ceiling.yaml";
};

TEST_F(MosaicFileTest, WhatIsWrittenIsRead) {
  put_whole();
  const auto read = read_ceiling(yaml_);
  ASSERT_TRUE(read) << read.error().message;
  const CeilingMosaic mosaic = small_mosaic();
  EXPECT_EQ(read->frame.columns, 3);
  EXPECT_EQ(read->frame.rows, 2);
  EXPECT_EQ(read->frame.resolution, 0.025);
  EXPECT_EQ(read->frame.origin, (Point2{-1.5, 2.125}));
  EXPECT_EQ(read->heights, mosaic.heights);
  EXPECT_EQ(read->part, mosaic.part);
  for (std::size_t i = 0; i < mosaic.brightness.size(); ++i)
    EXPECT_NEAR(read->brightness[i], mosaic.brightness[i], 2e-5F) << i;
  EXPECT_TRUE(write_ceiling(yaml_, *read)) << "over itself";
  EXPECT_EQ(read_file(yaml_)->find("cut_short"), std::string::npos);
}

TEST_F(MosaicFileTest, ThatItWasCutShortStandsInTheFile) {
  CeilingMosaic mosaic = small_mosaic();
  mosaic.is_cut_short = true;
  ASSERT_TRUE(write_ceiling(yaml_, mosaic));
  EXPECT_NE(read_file(yaml_)->find("cut_short: true"), std::string::npos);
  const auto read = read_ceiling(yaml_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_TRUE(read->is_cut_short);
  change("cut_short", "cut_short: false");
  EXPECT_FALSE(read_ceiling(yaml_)->is_cut_short);
}

TEST_F(MosaicFileTest, TheImagesFirstRowIsTheTop) {
  put_whole();
  const std::array<std::uint8_t, 6> parts{1, 0, 0, 255, 255, 255};
  put("ceiling-parts.png", *pictures::encode_png(3, 2, std::span<const std::uint8_t>{parts}));
  change("digest", "");
  const auto read = read_ceiling(yaml_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->part[read->frame.index({0, 1})], 1);
  EXPECT_EQ(read->part[read->frame.index({0, 0})], CeilingMosaic::kUnknown);
}

TEST_F(MosaicFileTest, NoticesATornSet) {
  put_whole();
  CeilingMosaic other = small_mosaic();
  other.brightness[0] = 0.7F;
  ASSERT_TRUE(write_ceiling(folder_ / "other.yaml", other));
  fs::rename(folder_ / "other-picture.png", folder_ / "ceiling-picture.png");
  EXPECT_EQ(fault().rfind("ceiling.yaml:7: ceiling-picture.png and ceiling-parts.png are not those", 0), 0U) << fault();
  const std::string png = *read_file(folder_ / "ceiling-parts.png");
  for (const std::size_t bytes : {std::size_t{0}, std::size_t{20}, png.size() / 2, png.size() - 1}) {
    put("ceiling-parts.png", std::string_view{png}.substr(0, bytes));
    EXPECT_NE(fault(), "") << bytes << " bytes";
  }
  change("digest", "");
  put("ceiling-parts.png", std::string_view{png}.substr(0, png.size() / 2));
  EXPECT_EQ(fault().rfind("ceiling-parts.png:1: ", 0), 0U) << fault();
  fs::remove(folder_ / "ceiling-parts.png");
  EXPECT_EQ(fault().rfind("ceiling.yaml:2: parts ", 0), 0U) << fault();
}

TEST_F(MosaicFileTest, NamesFileAndLineOfWhatCannotBe) {
  const auto with = [&](const char* key, const std::string& line) {
    put_whole();
    change(key, line);
    return fault();
  };
  EXPECT_EQ(with("resolution", "resolution: 0").rfind("ceiling.yaml:3: resolution must", 0), 0U);
  EXPECT_EQ(with("resolution", "resolution: .nan").rfind("ceiling.yaml:3: ", 0), 0U);
  EXPECT_EQ(with("origin", "origin: [1]").rfind("ceiling.yaml:4: origin must", 0), 0U);
  EXPECT_EQ(with("origin", "origin: [1, .inf]").rfind("ceiling.yaml:4: ", 0), 0U);
  EXPECT_EQ(with("heights", "heights: []").rfind("ceiling.yaml:5: heights must", 0), 0U);
  EXPECT_EQ(with("heights", "heights: [3, -1]").rfind("ceiling.yaml:5: heights must", 0), 0U);
  EXPECT_EQ(with("heights", "heights: [3]"),
            "ceiling-parts.png:1: has a part 1, counted from 0, but there are 1 heights");
  EXPECT_EQ(with("brightness", "brightness: [1, 0]").rfind("ceiling.yaml:6: brightness must", 0), 0U);
  EXPECT_EQ(with("brightness", "bright: [0, 1]").rfind("ceiling.yaml:6: ", 0), 0U);
  EXPECT_EQ(with("picture", "picture: nowhere.png").rfind("ceiling.yaml:1: picture ", 0), 0U);
  put("ceiling.yaml", "");
  EXPECT_NE(fault(), "");
  put("ceiling.yaml", "[");
  EXPECT_EQ(fault().rfind("ceiling.yaml:", 0), 0U) << fault();
  put_whole();
  const std::array<std::uint8_t, 4> parts{};
  put("ceiling-parts.png", *pictures::encode_png(2, 2, std::span<const std::uint8_t>{parts}));
  EXPECT_EQ(fault(), "ceiling-parts.png:1: is 2 x 2 pixels, but ceiling-picture.png is 3 x 2");
  const auto image = read_ceiling(folder_ / "ceiling-parts.png");
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("name the YAML file"), std::string::npos);
}

TEST_F(MosaicFileTest, WritesNothingOfWhatIsNoMosaic) {
  CeilingMosaic mosaic = small_mosaic();
  EXPECT_FALSE(write_ceiling(folder_ / "ceiling", mosaic)) << "no extension";
  EXPECT_FALSE(write_ceiling(folder_ / "none" / "ceiling.yaml", mosaic)) << "no folder";
  mosaic.part[0] = 2;
  EXPECT_FALSE(write_ceiling(yaml_, mosaic)) << "a part without a height";
  mosaic = small_mosaic();
  mosaic.brightness.pop_back();
  EXPECT_FALSE(write_ceiling(yaml_, mosaic));
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace docent::vision::mosaic_file_test
