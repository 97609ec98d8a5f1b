#include "docent/vision/things/thing_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

namespace docent::vision {
namespace {

constexpr pictures::Color kSheet{215, 215, 215, 255};

using Rgb3 = std::array<double, 3>;

/// Between four pixels. Nothing: outside.
std::optional<Rgb3> color_at(const pictures::Image& picture, const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(std::floor(pixel.x())), y = static_cast<int>(std::floor(pixel.y()));
  if (x < 0 || y < 0 || x + 1 >= picture.width() || y + 1 >= picture.height()) return std::nullopt;
  const double u = pixel.x() - x, v = pixel.y() - y;
  Rgb3 sum{};
  for (const auto& [dx, dy, weight] : std::array<std::tuple<int, int, double>, 4>{
           {{0, 0, (1 - u) * (1 - v)}, {1, 0, u * (1 - v)}, {0, 1, (1 - u) * v}, {1, 1, u * v}}}) {
    const pictures::Color c = picture.at(x + dx, y + dy);
    sum[0] += weight * c.red, sum[1] += weight * c.green, sum[2] += weight * c.blue;
  }
  return sum;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double unlike(const Rgb3& a, const Rgb3& b) {
  const double light = (a[0] + a[1] + a[2] - b[0] - b[1] - b[2]) / 3.0;
  const double red_green = (a[0] - a[1]) - (b[0] - b[1]);
  const double yellow_blue = 0.5 * (a[0] + a[1]) - a[2] - (0.5 * (b[0] + b[1]) - b[2]);
  return std::sqrt(light * light + red_green * red_green + yellow_blue * yellow_blue);
}

std::uint8_t level(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

/// A plane through the thing's middle that faces the camera.
struct FacingPlane {
  const pictures::Image& picture;
  const FrontCamera& camera;
  Eigen::Vector3d middle, right, up;
  [[nodiscard]] std::optional<Rgb3> at(double u, double v) const {
    const auto pixel = camera.pixel_of(middle + u * right + v * up);
    return pixel ? color_at(picture, *pixel) : std::nullopt;
  }
};

/// How far [m] the thing lies beside where the depth camera has it, for two mounts are never known exactly: where its
/// rectangle differs most from the ground about it.
Eigen::Vector2d shift_of(const FacingPlane& plane, double width, double shown) {
  constexpr double kStep = 0.005, kMost = 0.03;  // [m]
  constexpr double kGrey = 4.0;                  // [grey levels] a centimetre: a shift that gains less is none
  const int columns = static_cast<int>((0.5 * width + 2.0 * kMost) / kStep),
            rows = static_cast<int>((0.5 * shown + 2.0 * kMost) / kStep);
  const int wide = 2 * columns + 1;
  std::vector<std::optional<Rgb3>> seen;
  std::array<std::vector<double>, 3> ring;
  for (int row = -rows; row <= rows; ++row) {
    for (int column = -columns; column <= columns; ++column) {
      const double u = kStep * column, v = kStep * row;
      seen.push_back(plane.at(u, v));
      if (!seen.back() || (std::abs(u) < 0.5 * width + kMost && std::abs(v) < 0.5 * shown + kMost)) continue;
      for (std::size_t k = 0; k < 3; ++k) ring.at(k).push_back((*seen.back()).at(k));
    }
  }
  if (ring[0].empty()) return {0.0, 0.0};
  const Rgb3 ground{median_of(ring[0]), median_of(ring[1]), median_of(ring[2])};
  const int half_columns = static_cast<int>(0.5 * width / kStep), half_rows = static_cast<int>(0.5 * shown / kStep);
  const int most = static_cast<int>(kMost / kStep);
  Eigen::Vector2d best{0.0, 0.0};
  double worth_most = -1e9;
  for (int dv = -most; dv <= most; ++dv) {
    for (int du = -most; du <= most; ++du) {
      double sum = 0.0;
      int count = 0;
      for (int row = dv - half_rows; row <= dv + half_rows; ++row) {
        for (int column = du - half_columns; column <= du + half_columns; ++column) {
          const auto& color = seen[static_cast<std::size_t>((row + rows) * wide + column + columns)];
          if (!color) continue;
          sum += unlike(*color, ground);
          ++count;
        }
      }
      const double worth = sum / std::max(1, count) - kGrey * std::hypot(du, dv) * kStep / 0.01;
      if (worth <= worth_most) continue;
      worth_most = worth;
      best = {kStep * du, kStep * dv};
    }
  }
  return best;
}

}  // namespace

std::optional<pictures::Image> thing_patch(const pictures::Image& picture, const FrontCamera& camera,
                                           const ThingPlace& place) {
  const Eigen::Vector3d middle{place.middle.x, place.middle.y, 0.5 * place.height};
  const Eigen::Vector3d sight = (middle - camera.position).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d{sight.y(), -sight.x(), 0.0}.normalized();
  const Eigen::Vector3d up = right.cross(sight);
  // What the camera sees of it from above, its upper side included, is stretched to its height.
  const double shown = place.height * up.z() + place.width * std::abs(sight.z());
  const FacingPlane plane{picture, camera, middle, right, up};
  const Eigen::Vector2d shift = shift_of(plane, place.width, shown);
  pictures::Image patch{kPatchSide, kPatchSide, kSheet};
  for (int row = 0; row < kPatchSide; ++row) {
    for (int column = 0; column < kPatchSide; ++column) {
      const double u = ((column + 0.5) / kPatchSide - 0.5) * kPatchSize;
      const double v = (0.5 - (row + 0.5) / kPatchSide) * kPatchSize;
      if (std::abs(u) > 0.5 * place.width || std::abs(v) > 0.5 * place.height) continue;
      const auto color = plane.at(u + shift.x(), v * shown / place.height + shift.y());
      if (!color) return std::nullopt;
      patch.set(column, row, {level((*color)[0]), level((*color)[1]), level((*color)[2]), 255});
    }
  }
  return patch;
}

}  // namespace docent::vision
