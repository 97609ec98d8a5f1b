#include "docent/recording/mcap/lz4.h"

#include <gtest/gtest.h>
#include <lz4frame.h>

#include <string>

namespace docent::recording::mcap {
namespace {

std::vector<std::uint8_t> packed(const std::string& text) {
  std::vector<std::uint8_t> bytes(LZ4F_compressFrameBound(text.size(), nullptr));
  bytes.resize(LZ4F_compressFrame(bytes.data(), bytes.size(), text.data(), text.size(), nullptr));
  return bytes;
}

TEST(Lz4, AFrameComesBackAsItWas) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{3'000'000}}) {
    std::string text;
    while (text.size() < size) text += static_cast<char>('a' + text.size() * text.size() % 23);
    const auto bytes = unpack_lz4(packed(text), size);
    ASSERT_TRUE(bytes) << size;
    EXPECT_TRUE(std::equal(bytes->begin(), bytes->end(), text.begin(), text.end()));
  }
}

TEST(Lz4, AnotherSizeAndDamageAreFaults) {
  std::string text(5000, 'x');
  for (std::size_t i = 0; i < text.size(); i += 7) text[i] = static_cast<char>(i % 251);
  auto bytes = packed(text);
  EXPECT_FALSE(unpack_lz4(bytes, 4999));
  EXPECT_FALSE(unpack_lz4(bytes, 5001));
  EXPECT_FALSE(unpack_lz4(bytes, std::size_t{1} << 40U));
  EXPECT_FALSE(unpack_lz4({bytes.data(), bytes.size() / 2}, 5000));
  bytes[0] ^= 1;
  EXPECT_FALSE(unpack_lz4(bytes, 5000));
}

}  // namespace
}  // namespace docent::recording::mcap
