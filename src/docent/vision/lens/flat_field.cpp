#include "docent/vision/lens/flat_field.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace docent::vision {
namespace {

constexpr std::size_t kLeastPictures = 30;
constexpr int kStep = 8;              // [pixels] of the grid that is looked at
constexpr double kMostBurnt = 0.02;   // share of a picture's pixels
constexpr std::uint8_t kBurnt = 250;  // and above
constexpr double kLeastLight = 0.2;   // a lens that loses more is none

}  // namespace

double FlatField::at(double column, double row) const {
  const double x = (column - centre_x) / half, y = (row - centre_y) / half, r = x * x + y * y;
  return std::max(kLeastLight, 1.0 + r * (square + fourth * r));
}

FlatField flat_field_of(std::span<const std::span<const std::uint8_t>> pictures, const Lens& lens) {
  const LensParams& params = lens.params();
  FlatField field{params.centre_x, params.centre_y, 0.5 * std::hypot(params.columns, params.rows), 0.0, 0.0};
  const int columns = params.columns / kStep, rows = params.rows / kStep;
  std::vector<std::vector<float>> shares(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (const std::span<const std::uint8_t> picture : pictures) {
    const auto burnt = std::count_if(picture.begin(), picture.end(), [](auto b) { return b >= kBurnt; });
    if (static_cast<double>(burnt) > kMostBurnt * static_cast<double>(picture.size())) continue;
    const double sum = std::accumulate(picture.begin(), picture.end(), 0.0);
    const double mean = std::max(1.0, sum / static_cast<double>(picture.size()));
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const auto at = static_cast<std::size_t>(row * kStep + kStep / 2) * static_cast<std::size_t>(params.columns) +
                        static_cast<std::size_t>(column * kStep + kStep / 2);
        shares[static_cast<std::size_t>(row * columns + column)].push_back(static_cast<float>(picture[at] / mean));
      }
  }
  if (shares.empty() || shares.front().size() < kLeastPictures) return field;
  // light = a + b r^2 + c r^4, by least squares.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      auto& share = shares[static_cast<std::size_t>(row * columns + column)];
      const auto middle = share.begin() + static_cast<std::ptrdiff_t>(share.size() / 2);
      std::nth_element(share.begin(), middle, share.end());
      const double x = (column * kStep + kStep / 2 - field.centre_x) / field.half;
      const double y = (row * kStep + kStep / 2 - field.centre_y) / field.half, r = x * x + y * y;
      const Eigen::Vector3d powers{1.0, r, r * r};
      normal += powers * powers.transpose();
      right += powers * static_cast<double>(*middle);
    }
  const Eigen::Vector3d found = normal.ldlt().solve(right);
  if (!found.allFinite() || found[0] <= 0.0) return field;
  field.square = found[1] / found[0], field.fourth = found[2] / found[0];
  return field;
}

std::vector<std::uint8_t> flattened(std::span<const std::uint8_t> picture, int columns, const FlatField& field) {
  const int rows = static_cast<int>(picture.size()) / columns;
  double least = 1.0;
  for (const int row : {0, rows - 1})
    for (const int column : {0, columns - 1}) least = std::min(least, field.at(column, row));
  std::vector<std::uint8_t> bytes(picture.begin(), picture.end());
  std::size_t at = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column, ++at)
      if (bytes[at] != 255)
        bytes[at] = static_cast<std::uint8_t>(std::lround(std::min(255.0, bytes[at] * least / field.at(column, row))));
  return bytes;
}

}  // namespace docent::vision
