#include "docent/vision/lens/lens_file.h"

#include <gtest/gtest.h>

namespace docent::vision::lens_file_test {
namespace {

Result<Lens> read(const std::string& text) {
  const auto file = YamlFile::parse(text, "c.yaml");
  EXPECT_TRUE(file) << file.error().message;
  return read_lens(*file, file->root()["up"]);
}

TEST(LensFile, WhatIsWrittenIsRead) {
  for (const auto kind : {LensParams::Kind::pinhole, LensParams::Kind::fisheye}) {
    LensParams lens{.kind = kind, .columns = 320, .rows = 240, .focal_x = 205.25, .focal_y = 204.5};
    lens.centre_x = 161.0, lens.centre_y = 118.2;
    lens.bend = {-0.025, 0.003, 0.0006, -0.0004, 0.0};
    const std::string text = "up:\n" + lens_to_yaml(lens, "  ") + "  mount: {x: 0}\n";
    const auto back = read(text);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->params().kind, kind);
    EXPECT_EQ(back->params().columns, 320);
    EXPECT_DOUBLE_EQ(back->params().focal_y, 204.5);
    EXPECT_DOUBLE_EQ(back->params().centre_y, 118.2);
    EXPECT_EQ(back->params().bend, lens.bend);
    EXPECT_NE(text.find("centre: [161.5, 118.7]"), std::string::npos) << "from the corner of the picture";
  }
}

TEST(LensFile, NamesFileAndLineOfWhatCannotBe) {
  const std::string good =
      "up:\n  model: brown\n  width: 320\n  height: 240\n  focal: [200, 200]\n  centre: [160, 120]\n"
      "  distortion: [0, 0, 0, 0, 0]\n";
  ASSERT_TRUE(read(good));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const auto lens = read(text);
    return lens ? "" : lens.error().message;
  };
  EXPECT_EQ(with("brown", "wide"), "c.yaml:2: model must be brown or fisheye, found 'wide'");
  EXPECT_EQ(with("brown", "fisheye"), "c.yaml:7: distortion of a fisheye lens must be 4 numbers");
  EXPECT_EQ(with("[200, 200]", "[200]"), "c.yaml:5: focal must be [x, y] in pixels");
  EXPECT_EQ(with("[160, 120]", "160").rfind("c.yaml:6: ", 0), 0U);
  EXPECT_EQ(with("[200, 200]", "[0, 200]").rfind("c.yaml:", 0), 0U) << with("[200, 200]", "[0, 200]");
  EXPECT_EQ(with("width", "widht").rfind("c.yaml:", 0), 0U);
  EXPECT_EQ(with("  height: 240\n", "  height: 240\n  skew: 1\n"), "c.yaml:5: unknown key 'skew'");
  EXPECT_FALSE(read("up: 3\n"));
}

}  // namespace
}  // namespace docent::vision::lens_file_test
