#include "docent/telepresence/museum_office/exhibit_picture.h"

#include <gtest/gtest.h>
#include <openssl/evp.h>

#include "docent/pictures/jpeg/jpeg.h"

namespace docent::telepresence {
namespace {

std::string base64_of(const std::vector<std::uint8_t>& bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::vector<std::uint8_t> jpeg_of(int width, int height) {
  return pictures::encode_jpeg(pictures::Image{width, height, pictures::Color{200, 40, 40}}, 90);
}

TEST(ExhibitPicture, IsDrawnAnewWithoutWhatIsNoPicture) {
  std::vector<std::uint8_t> file = jpeg_of(64, 48);
  const std::string secret = "51.4416 N 5.4697 E";
  const auto length = static_cast<std::uint8_t>(secret.size() + 2);
  std::vector<std::uint8_t> comment{0xff, 0xfe, 0, length};
  comment.insert(comment.end(), secret.begin(), secret.end());
  file.insert(file.begin() + 2, comment.begin(), comment.end());
  ASSERT_TRUE(pictures::decode_jpeg(file));
  const auto kept = exhibit_picture(base64_of(file));
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->find(secret), std::string::npos);
  const std::vector<std::uint8_t> bytes{kept->begin(), kept->end()};
  const auto size = pictures::jpeg_size(bytes);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 64);
  EXPECT_EQ(size->height, 48);
}

TEST(ExhibitPicture, RefusesWhatIsNone) {
  std::vector<std::uint8_t> cut = jpeg_of(64, 48);
  cut.resize(cut.size() - 20);
  const std::string page = "<svg onload=\"alert(1)\"/>";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "base64"},
      {"====", "base64"},
      {"AA", "base64"},
      {"!!!!", "base64"},
      {base64_of({page.begin(), page.end()}), "no JPEG"},
      {base64_of(cut), "cut short"},
      {base64_of(jpeg_of(4, 48)), "4 x 48 pixels"},
      {base64_of(jpeg_of(2600, 20)), "2600 x 20 pixels"},
  };
  for (const auto& [sent, why] : cases) {
    const auto kept = exhibit_picture(sent);
    ASSERT_FALSE(kept) << why;
    EXPECT_NE(kept.error().message.find(why), std::string::npos) << kept.error().message;
  }
}

}  // namespace
}  // namespace docent::telepresence
