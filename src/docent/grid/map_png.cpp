#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <string>

#include "docent/grid/map_image.h"

namespace docent {
namespace {

/// libpng's samples as they lie in the file: its own conversions to grey weigh colours as an eye does, and by a gamma.
class PngImage final : public MapImage {
 public:
  explicit PngImage(const std::filesystem::path& path) : name_{path.string()}, file_{std::fopen(path.c_str(), "rb")} {}
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
  ~PngImage() override {
    if (png_ != nullptr) png_destroy_read_struct(&png_, &info_, nullptr);
    if (file_ != nullptr) std::fclose(file_);
  }

  Result<void> open() {
    if (file_ == nullptr) return fail(name_ + ": cannot be read");
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngImage::keep_error, [](png_structp, auto) {});
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) return fail(name_ + ":1: no memory for a PNG image");
    if (!read_header()) return fail(name_ + ":1: damaged PNG image: " + message_);
    row_.resize(bytes_of_row_);
    const bool is_interlaced = passes_ > 1;
    if (is_interlaced) {
      constexpr std::size_t kMostBytes = std::size_t{1} << 30U;
      if (bytes_of_row_ > kMostBytes / static_cast<std::size_t>(header.height))
        return fail(name_ + ":1: an interlaced PNG image of this size; save it without interlacing");
      whole_.resize(bytes_of_row_ * static_cast<std::size_t>(header.height));
      for (long row = 0; row < header.height; ++row)
        rows_.push_back(&whole_[bytes_of_row_ * static_cast<std::size_t>(row)]);
      if (!read_whole()) return fail(name_ + ":1: damaged PNG image: " + message_);
    }
    return {};
  }

  Result<void> read_row(std::vector<std::uint32_t>& shades) override {
    if (rows_.empty() && !read_next()) return fail(name_ + ":1: damaged PNG image: " + message_);
    const unsigned char* from = rows_.empty() ? row_.data() : rows_[static_cast<std::size_t>(next_++)];
    shades.resize(static_cast<std::size_t>(header.width));
    if (is_by_palette_) {
      for (auto& shade : shades) {
        if (*from >= colours_) return fail(name_ + ":1: damaged PNG image: a colour that its palette has not");
        shade = palette_[*from++];
      }
      return {};
    }
    const std::size_t width = depth_ == 16 ? 2 : 1;
    const int colours = channels_ >= 3 ? 3 : 1;
    const bool has_alpha = channels_ == 2 || channels_ == 4;
    const std::uint32_t half = depth_ == 16 ? 32768 : 128;
    const auto sample = [&] {
      const std::uint32_t value = width == 1 ? from[0] : static_cast<std::uint32_t>(from[0]) << 8U | from[1];
      from += width;
      return value;
    };
    for (auto& shade : shades) {
      shade = 0;
      for (int i = 0; i < colours; ++i) shade += sample();
      if (has_alpha && sample() < half) shade = kClear;
    }
    return {};
  }

 private:
  // libpng comes back from a fault by longjmp: none of these three has anything to destroy.
  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, file_);
    png_read_info(png_, info_);
    is_by_palette_ = png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE;
    if (is_by_palette_)
      png_set_packing(png_);  // 1 to 4 bits to 8
    else
      png_set_expand(png_);  // 1 to 4 bits to 8 and to full white, a clear colour to alpha
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    header.width = static_cast<long>(png_get_image_width(png_, info_));
    header.height = static_cast<long>(png_get_image_height(png_, info_));
    depth_ = png_get_bit_depth(png_, info_);
    channels_ = png_get_channels(png_, info_);
    bytes_of_row_ = png_get_rowbytes(png_, info_);
    header.white = (depth_ == 16 ? 65535U : 255U) * (channels_ >= 3 || is_by_palette_ ? 3U : 1U);
    png_colorp colours = nullptr;
    png_bytep alphas = nullptr;
    int count = 0, clear = 0;
    if (is_by_palette_) png_get_PLTE(png_, info_, &colours, &count);
    if (is_by_palette_ && png_get_tRNS(png_, info_, &alphas, &clear, nullptr) == 0) clear = 0;
    for (int i = 0; i < count; ++i)
      palette_[static_cast<std::size_t>(i)] =
          i < clear && alphas[i] < 128 ? kClear : colours[i].red + std::uint32_t{colours[i].green} + colours[i].blue;
    colours_ = static_cast<std::size_t>(count);
    return true;
  }
  bool read_next() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_row(png_, row_.data(), nullptr);
    return true;
  }
  bool read_whole() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_read_image(png_, rows_.data());
    return true;
  }
  [[noreturn]] static void keep_error(png_structp png, png_const_charp what) {
    static_cast<PngImage*>(png_get_error_ptr(png))->message_ = what;
    png_longjmp(png, 1);
  }

  const std::string name_;
  std::FILE* file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int depth_ = 8, channels_ = 1, passes_ = 1;
  std::size_t bytes_of_row_ = 0;
  std::vector<unsigned char> row_, whole_;  // whole_: of an interlaced image
  std::vector<png_bytep> rows_;
  long next_ = 0;
  bool is_by_palette_ = false;
  std::array<std::uint32_t, 256> palette_{};  ///< shades
  std::size_t colours_ = 0;                   ///< so many of them
  std::string message_;
};

}  // namespace

Result<std::unique_ptr<MapImage>> open_png(const std::filesystem::path& path) {
  auto image = std::make_unique<PngImage>(path);
  if (auto opened = image->open(); !opened) return tl::unexpected<Error>(opened.error());
  return image;
}

}  // namespace docent
