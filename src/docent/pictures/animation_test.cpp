#include "docent/pictures/animation.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <webp/demux.h>

#include "docent/base/files.h"

namespace docent::pictures {
namespace {

TEST(Animation, FramesComeBackPixelForPixel) {
  auto animation = Animation::create(64, 32);
  ASSERT_TRUE(animation);
  std::vector<Image> images;
  for (int i = 0; i < 4; ++i) {
    images.emplace_back(64, 32);
    for (int x = 0; x < 12; ++x) images.back().set(10 + 12 * i + x, 16, distinct(i));
    ASSERT_TRUE(animation->add(images.back(), std::chrono::milliseconds{100 + 50 * i}));
  }
  const auto path = std::filesystem::temp_directory_path() / ("docent_animation_" + std::to_string(getpid()) + ".webp");
  ASSERT_TRUE(animation->save(path));
  const auto bytes = read_file(path);
  std::filesystem::remove(path);
  ASSERT_TRUE(bytes);

  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()};
  WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
  ASSERT_NE(decoder, nullptr);
  std::vector<int> ends;
  while (WebPAnimDecoderHasMoreFrames(decoder) != 0) {
    std::uint8_t* pixels = nullptr;
    int end = 0;
    ASSERT_NE(WebPAnimDecoderGetNext(decoder, &pixels, &end), 0);
    const auto expected = images[ends.size()].bytes();
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), pixels));
    ends.push_back(end);
  }
  WebPAnimDecoderDelete(decoder);
  EXPECT_EQ(ends, (std::vector<int>{100, 250, 450, 700}));
}

TEST(Animation, RefusesWhatItCannotDo) {
  auto animation = Animation::create(8, 8);
  ASSERT_TRUE(animation);
  EXPECT_FALSE(animation->add(Image{9, 8}, std::chrono::milliseconds{10}));
  EXPECT_FALSE(animation->save("/tmp/never_written.webp"));
  EXPECT_FALSE(Animation::create(0, 8));
}

}  // namespace
}  // namespace docent::pictures
