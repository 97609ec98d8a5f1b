#pragma once

#include <filesystem>
#include <memory>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/pictures/image.h"

namespace docent::pictures {

/// An animated WebP, lossless, that repeats for ever. Frames are compressed as they come, so memory stays small.
class Animation {
 public:
  /// All frames have this size.
  [[nodiscard]] static Result<Animation> create(int width, int height);
  Animation(Animation&&) noexcept;
  Animation& operator=(Animation&&) noexcept;
  ~Animation();

  /// Shows `image` for `duration` (at least a millisecond). Error: wrong size, or the encoder refuses.
  [[nodiscard]] Result<void> add(const Image& image, Duration duration);
  [[nodiscard]] int frames() const;
  /// Writes atomically. Error: no frame. Call once, at the end.
  [[nodiscard]] Result<void> save(const std::filesystem::path& path);

 private:
  struct Encoder;
  explicit Animation(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace docent::pictures
