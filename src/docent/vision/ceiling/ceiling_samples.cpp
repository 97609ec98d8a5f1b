#include "docent/vision/ceiling/ceiling_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr int kLargestBlock = 64;  // [pixels] whose sums fit 16 bits
constexpr std::size_t kAtOnce = 16;
constexpr double kLeastRise = 0.05;  // of a ray of length 1: flatter ones look at walls

/// Of kAtOnce columns. Copies, so that the compiler sees that sums and pixels are not the same bytes, and takes them
/// together.
inline void add_row(std::uint16_t* sums, const std::uint8_t* pixels) {
  std::array<std::uint16_t, kAtOnce> sum;
  std::array<std::uint8_t, kAtOnce> more;
  std::memcpy(sum.data(), sums, sizeof sum);
  std::memcpy(more.data(), pixels, sizeof more);
  for (std::size_t i = 0; i < kAtOnce; ++i) sum[i] = static_cast<std::uint16_t>(sum[i] + more[i]);
  std::memcpy(sums, sum.data(), sizeof sum);
}

}  // namespace

CeilingSampler::CeilingSampler(const CeilingCamera& camera, const CeilingSamplesParams& params)
    : camera_{camera},
      params_{params},
      columns_{camera.lens.params().columns / params.block},
      rows_{camera.lens.params().rows / params.block} {
  DOCENT_CHECK(params.block > 0 && params.block <= kLargestBlock && params.flat_step > 0 && params.most > 0);
  means_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  column_sums_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(params.block));
  const double middle = 0.5 * (params.block - 1);
  std::vector<bool> looks_up(means_.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto ray = camera.lens.ray_of({column * params.block + middle, row * params.block + middle});
      if (!ray) continue;
      const Eigen::Vector3d up = camera.mount.robot_from_camera * *ray;
      if (up.z() < kLeastRise) continue;
      const double x = up.x() / up.z(), y = up.y() / up.z();
      if (x * x + y * y > params.steepest * params.steepest) continue;
      const int index = row * columns_ + column;
      looks_up[static_cast<std::size_t>(index)] = true;
      blocks_.push_back({index, static_cast<float>(x), static_cast<float>(y), false,
                         column % params.flat_step == 0 && row % params.flat_step == 0});
    }
  }
  for (Block& block : blocks_) {
    const int column = block.index % columns_, row = block.index / columns_;
    const auto up = [&](int i) { return looks_up[static_cast<std::size_t>(i)]; };
    block.is_inner = column > 0 && row > 0 && column + 1 < columns_ && row + 1 < rows_ && up(block.index - 1) &&
                     up(block.index + 1) && up(block.index - columns_) && up(block.index + columns_);
  }
}

void CeilingSampler::take_means(const GrayPicture& picture) {
  const auto side = static_cast<std::size_t>(params_.block), width = static_cast<std::size_t>(picture.columns);
  const float scale = 1.0F / (255.0F * static_cast<float>(side * side));
  const std::size_t used = column_sums_.size();
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows_); ++row) {
    std::fill(column_sums_.begin(), column_sums_.end(), std::uint16_t{0});
    std::uint16_t* sums = column_sums_.data();
    for (std::size_t line = 0; line < side; ++line) {
      const std::uint8_t* pixels = picture.bytes.data() + (row * side + line) * width;
      std::size_t i = 0;
      for (; i + kAtOnce <= used; i += kAtOnce) add_row(sums + i, pixels + i);
      for (; i < used; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + pixels[i]);
    }
    float* means = means_.data() + row * static_cast<std::size_t>(columns_);
    for (std::size_t column = 0; column < static_cast<std::size_t>(columns_); ++column) {
      std::uint32_t sum = 0;
      for (std::size_t i = 0; i < side; ++i) sum += column_sums_[column * side + i];
      means[column] = scale * static_cast<float>(sum);
    }
  }
}

std::span<const CeilingSample> CeilingSampler::take(const GrayPicture& picture) {
  DOCENT_CHECK(picture.columns == camera_.lens.params().columns && picture.rows == camera_.lens.params().rows);
  DOCENT_CHECK(picture.bytes.size() ==
               static_cast<std::size_t>(picture.columns) * static_cast<std::size_t>(picture.rows));
  take_means(picture);
  edges_.clear();
  taken_.clear();
  const auto edge = static_cast<float>(params_.edge);
  double sum = 0.0, squares = 0.0;
  for (const Block& block : blocks_) {
    const float* at = means_.data() + block.index;
    const auto value = static_cast<double>(*at);
    sum += value, squares += value * value;
    const CeilingSample sample{block.slope_x, block.slope_y, *at};
    if (block.is_inner && std::abs(at[1] - at[-1]) + std::abs(at[columns_] - at[-columns_]) > edge) {
      edges_.push_back(sample);
    } else if (block.is_sparse) {
      taken_.push_back(sample);
    }
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, blocks_.size()));
  contrast_ = std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
  const auto most = static_cast<std::size_t>(params_.most);
  const std::size_t chosen = std::min(most, edges_.size());
  for (std::size_t i = 0; i < chosen; ++i) taken_.push_back(edges_[i * edges_.size() / chosen]);
  return taken_;
}

}  // namespace docent::vision
