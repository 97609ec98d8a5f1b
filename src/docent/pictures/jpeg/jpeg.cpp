#include "docent/pictures/jpeg/jpeg.h"

#include <turbojpeg.h>

#include <memory>
#include <string>
#include <type_traits>

#include "docent/base/check.h"

namespace docent::pictures {
namespace {

struct Destroy {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Codec = std::unique_ptr<std::remove_pointer_t<tjhandle>, Destroy>;

unsigned long length_of(std::span<const std::uint8_t> file) { return static_cast<unsigned long>(file.size()); }

tl::unexpected<Error> fault_of(const Codec& codec) {
  return fail(std::string{"no JPEG: "} + tjGetErrorStr2(codec.get()));
}

Result<JpegSize> read_size(const Codec& codec, std::span<const std::uint8_t> file) {
  JpegSize size;
  int sampling = 0;
  int colors = 0;
  if (tjDecompressHeader3(codec.get(), file.data(), length_of(file), &size.width, &size.height, &sampling, &colors) !=
      0)
    return fault_of(codec);
  return size;
}

}  // namespace

std::vector<std::uint8_t> encode_jpeg(const Image& image, int quality) {
  DOCENT_CHECK(quality >= 1 && quality <= 100);
  const Codec codec{tjInitCompress()};
  DOCENT_CHECK(codec != nullptr);
  std::vector<std::uint8_t> file(tjBufSize(image.width(), image.height(), TJSAMP_420));
  unsigned char* to = file.data();
  auto length = static_cast<unsigned long>(file.size());
  const int status = tjCompress2(codec.get(), image.bytes().data(), image.width(), 0, image.height(), TJPF_RGBX, &to,
                                 &length, TJSAMP_420, quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT);
  DOCENT_CHECK(status == 0);
  file.resize(length);
  return file;
}

Result<JpegSize> jpeg_size(std::span<const std::uint8_t> file) {
  const Codec codec{tjInitDecompress()};
  DOCENT_CHECK(codec != nullptr);
  return read_size(codec, file);
}

Result<Image> decode_jpeg(std::span<const std::uint8_t> file, int longest) {
  const Codec codec{tjInitDecompress()};
  DOCENT_CHECK(codec != nullptr);
  const auto size = read_size(codec, file);
  if (!size) return tl::unexpected<Error>(size.error());
  if (size->width < 1 || size->height < 1 || size->width > longest || size->height > longest)
    return fail("the picture is " + std::to_string(size->width) + " x " + std::to_string(size->height) + " pixels");
  Image image{size->width, size->height};
  // Warnings count: a file that was cut short is read with one, and would end in grey.
  if (tjDecompress2(codec.get(), file.data(), length_of(file), image.writable_bytes().data(), size->width, 0,
                    size->height, TJPF_RGBA, TJFLAG_STOPONWARNING) != 0)
    return fault_of(codec);
  return image;
}

}  // namespace docent::pictures
