#include "docent/pictures/png/png_file.h"

#include <png.h>

#include <csetjmp>
#include <vector>

#include "docent/base/check.h"

namespace docent::pictures {
namespace {

constexpr int kFast = 3;  // of zlib's levels: a third of the time of its default for a tenth more bytes

class PngWriter {
 public:
  PngWriter() : png_{png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr)} {
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
  }
  ~PngWriter() {
    if (png_ != nullptr) png_destroy_write_struct(&png_, &info_);
  }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;

  Result<std::string> write(int width, int height, int depth, int colors, std::span<std::uint8_t*> rows) {
    if (info_ == nullptr || !fill(width, height, depth, colors, rows)) return fail("a PNG picture: no memory");
    return std::move(file_);
  }

 private:
  // libpng comes back from a fault by longjmp: nothing here has anything to destroy.
  bool fill(int width, int height, int depth, int colors, std::span<std::uint8_t*> rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(
        png_, &file_,
        [](png_structp png, png_bytep bytes, std::size_t count) {
          static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
        },
        nullptr);
    png_set_compression_level(png_, kFast);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), depth, colors,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png_, info_);
    png_write_image(png_, rows.data());
    png_write_end(png_, nullptr);
    return true;
  }

  png_structp png_;
  png_infop info_ = nullptr;
  std::string file_;
};

Result<std::string> encode(int width, int height, int depth, int colors, std::vector<std::uint8_t> bytes) {
  std::vector<std::uint8_t*> rows;
  const std::size_t step = bytes.size() / static_cast<std::size_t>(height);
  for (int y = 0; y < height; ++y) rows.push_back(bytes.data() + static_cast<std::size_t>(y) * step);
  return PngWriter{}.write(width, height, depth, colors, rows);
}

void check_size(int width, int height, std::size_t pixels) {
  DOCENT_CHECK(width > 0 && height > 0 && pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

}  // namespace

Result<std::string> encode_png(int width, int height, std::span<const std::uint8_t> grey) {
  check_size(width, height, grey.size());
  return encode(width, height, 8, PNG_COLOR_TYPE_GRAY, {grey.begin(), grey.end()});
}

Result<std::string> encode_png(int width, int height, std::span<const std::uint16_t> grey) {
  check_size(width, height, grey.size());
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * grey.size());
  for (const std::uint16_t value : grey) {  // the higher byte first
    bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  }
  return encode(width, height, 16, PNG_COLOR_TYPE_GRAY, std::move(bytes));
}

Result<std::string> encode_png(const Image& image) {
  std::vector<std::uint8_t> bytes;
  const auto from = image.bytes();
  bytes.reserve(from.size() / 4 * 3);
  for (std::size_t i = 0; i < from.size(); i += 4) bytes.insert(bytes.end(), {from[i], from[i + 1], from[i + 2]});
  return encode(image.width(), image.height(), 8, PNG_COLOR_TYPE_RGB, std::move(bytes));
}

}  // namespace docent::pictures
