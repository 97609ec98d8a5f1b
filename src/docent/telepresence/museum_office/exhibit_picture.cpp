#include "docent/telepresence/museum_office/exhibit_picture.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "docent/pictures/jpeg/jpeg.h"

namespace docent::telepresence {
namespace {

constexpr int kShortest = 16, kLongest = 2560;  // [pixels] a side: more than a screen shows, and 26 MB while it is read
constexpr int kQuality = 88;                    // of 100: the eye sees no difference

/// Empty: it is none.
std::vector<std::uint8_t> bytes_of(std::string_view base64) {
  const auto is_digit = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
  };
  const std::size_t padding = base64.size() - std::min(base64.size(), base64.find_last_not_of('=') + 1);
  const bool is_whole = !base64.empty() && base64.size() % 4 == 0 && padding <= 2;
  if (!is_whole || !std::all_of(base64.begin(), base64.end() - static_cast<std::ptrdiff_t>(padding), is_digit))
    return {};
  std::vector<std::uint8_t> bytes(base64.size() / 4 * 3);
  const int length = EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(base64.data()),
                                     static_cast<int>(base64.size()));
  if (length != static_cast<int>(bytes.size())) return {};
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace

Result<std::string> exhibit_picture(std::string_view base64) {
  const std::vector<std::uint8_t> file = bytes_of(base64);
  if (file.empty()) return fail("the picture is not base64");
  const auto size = pictures::jpeg_size(file);
  if (!size) return fail("the picture is no JPEG");
  if (std::min(size->width, size->height) < kShortest || std::max(size->width, size->height) > kLongest)
    return fail("the picture has " + std::to_string(size->width) + " x " + std::to_string(size->height) +
                " pixels; a side may have " + std::to_string(kShortest) + " to " + std::to_string(kLongest));
  const auto image = pictures::decode_jpeg(file, kLongest);
  if (!image) return fail("the picture cannot be read: it is damaged or cut short");
  const std::vector<std::uint8_t> anew = pictures::encode_jpeg(*image, kQuality);
  return std::string{anew.begin(), anew.end()};
}

}  // namespace docent::telepresence
