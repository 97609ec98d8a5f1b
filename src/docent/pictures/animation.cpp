#include "docent/pictures/animation.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <string>

#include "docent/base/files.h"

namespace docent::pictures {

struct Animation::Encoder {
  WebPAnimEncoder* webp = nullptr;
  WebPConfig config{};
  int width = 0;
  int height = 0;
  int frames = 0;
  std::int64_t next_ms = 0;

  Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() { WebPAnimEncoderDelete(webp); }
};

Animation::Animation(std::unique_ptr<Encoder> encoder) : encoder_{std::move(encoder)} {}
Animation::Animation(Animation&&) noexcept = default;
Animation& Animation::operator=(Animation&&) noexcept = default;
Animation::~Animation() = default;

Result<Animation> Animation::create(int width, int height) {
  auto encoder = std::make_unique<Encoder>();
  WebPAnimEncoderOptions options;
  if (WebPAnimEncoderOptionsInit(&options) == 0 || WebPConfigInit(&encoder->config) == 0)
    return fail("animation: libwebp has another version than its headers");
  encoder->config.lossless = 1;
  encoder->config.method = 1;
  encoder->config.quality = 40.0F;  // effort, as the frames are lossless
  encoder->webp = WebPAnimEncoderNew(width, height, &options);
  if (encoder->webp == nullptr)
    return fail("animation: no picture can be " + std::to_string(width) + " x " + std::to_string(height));
  encoder->width = width;
  encoder->height = height;
  return Animation{std::move(encoder)};
}

int Animation::frames() const { return encoder_->frames; }

Result<void> Animation::add(const Image& image, Duration duration) {
  if (image.width() != encoder_->width || image.height() != encoder_->height)
    return fail("animation: a frame of another size");
  WebPPicture picture;
  if (WebPPictureInit(&picture) == 0) return fail("animation: libwebp has another version than its headers");
  picture.use_argb = 1;
  picture.width = image.width();
  picture.height = image.height();
  const bool added =
      WebPPictureImportRGBA(&picture, image.bytes().data(), 4 * image.width()) != 0 &&
      WebPAnimEncoderAdd(encoder_->webp, &picture, static_cast<int>(encoder_->next_ms), &encoder_->config) != 0;
  WebPPictureFree(&picture);
  if (!added) return fail(std::string{"animation: "} + WebPAnimEncoderGetError(encoder_->webp));
  encoder_->next_ms += std::max<std::int64_t>(1, duration.count() / 1000000);
  ++encoder_->frames;
  return {};
}

Result<void> Animation::save(const std::filesystem::path& path) {
  if (encoder_->frames == 0) return fail(path.string() + ": an animation needs a frame");
  WebPData data;
  WebPDataInit(&data);
  const bool assembled =
      WebPAnimEncoderAdd(encoder_->webp, nullptr, static_cast<int>(encoder_->next_ms), nullptr) != 0 &&
      WebPAnimEncoderAssemble(encoder_->webp, &data) != 0;
  const std::string bytes{reinterpret_cast<const char*>(data.bytes), assembled ? data.size : 0};
  WebPDataClear(&data);
  if (!assembled) return fail(path.string() + ": " + WebPAnimEncoderGetError(encoder_->webp));
  return write_file_atomically(path, bytes);
}

}  // namespace docent::pictures
