#include <cstdlib>

#include "docent/pictures/jpeg/jpeg.h"

// Any bytes as a picture: an error or an image of the size that the file says, within bounds.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kLongest = 256;  // small, for speed
  const std::span<const std::uint8_t> file{data, size};
  const auto said = docent::pictures::jpeg_size(file);
  const auto image = docent::pictures::decode_jpeg(file, kLongest);
  if (image && (!said || image->width() != said->width || image->height() != said->height)) std::abort();
  if (image && (image->width() > kLongest || image->height() > kLongest)) std::abort();
  return 0;
}
