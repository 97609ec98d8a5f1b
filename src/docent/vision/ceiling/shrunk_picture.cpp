#include "docent/vision/ceiling/shrunk_picture.h"

#include "docent/base/check.h"

namespace docent::vision {

ShrunkPicture::ShrunkPicture(const GrayPicture& picture, int block)
    : block_{block}, columns_{picture.columns / block}, rows_{picture.rows / block}, scale_{1.0 / block} {
  DOCENT_CHECK(block > 0 && columns_ > 1 && rows_ > 1);
  values_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  const float share = 1.0F / (255.0F * static_cast<float>(block * block));
  const auto side = static_cast<std::size_t>(block), width = static_cast<std::size_t>(picture.columns);
  std::size_t cell = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows_); ++row) {
    for (std::size_t column = 0; column < static_cast<std::size_t>(columns_); ++column, ++cell) {
      unsigned sum = 0;
      for (std::size_t v = 0; v < side; ++v)
        for (std::size_t u = 0; u < side; ++u) sum += picture.bytes[(row * side + v) * width + column * side + u];
      values_[cell] = share * static_cast<float>(sum);
    }
  }
}

}  // namespace docent::vision
