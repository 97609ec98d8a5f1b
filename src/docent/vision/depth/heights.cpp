#include "docent/vision/depth/heights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::vision {
namespace {

constexpr int kBlock = 4;  // [pixels] side of the blocks in which silence is looked for

/// Nothing comes back to any pixel of a block.
bool is_silent(const DepthPicture& picture, int column, int row) {
  for (int y = row; y < row + kBlock; ++y)
    for (int x = column; x < column + kBlock; ++x)
      if (picture.depth[picture.index(x, y)] > 0.0F) return false;
  return true;
}

}  // namespace

Result<void> HeightParams::validate() const {
  if (!(low > 0.0 && drop > 0.0)) return fail("heights: low and drop must be > 0");
  if (!(robot_height > low)) return fail("heights: robot_height must be > low");
  if (!(sigmas >= 0.0 && tilt_sigma >= 0.0)) return fail("heights: sigmas and tilt_sigma must be >= 0");
  if (!(nearest >= 0.0 && reach > nearest)) return fail("heights: it takes 0 <= nearest < reach");
  if (!(floor_reach > 0.0 && drop_reach > 0.0)) return fail("heights: floor_reach and drop_reach must be > 0");
  if (!(blind_share >= 0.0 && blind_share <= 1.0)) return fail("heights: blind_share must be in 0..1");
  if (!(edge >= 0 && edge <= 7)) return fail("heights: edge must be in 0..7");
  if (!(flying > 0.0 && shadow >= 0.0)) return fail("heights: flying must be > 0 and shadow >= 0");
  return {};
}

HeightFinder::HeightFinder(const DepthCamera& camera, const HeightParams& params, const GroundPlaneParams& ground)
    : camera_{camera}, params_{params}, ground_params_{ground} {}

const Heights& HeightFinder::find(const DepthPicture& picture, Rng& rng) {
  found_.points.clear();
  found_.floor.clear();
  found_.ground = {};
  const auto seen = std::count_if(picture.depth.begin(), picture.depth.end(), [](float depth) { return depth > 0.0F; });
  found_.is_blind = static_cast<double>(seen) < params_.blind_share * static_cast<double>(picture.depth.size());
  if (found_.is_blind) return found_;
  points_.fill(camera_, picture);
  found_.ground = find_ground_plane(picture, points_, ground_params_, rng);
  sort_pixels(picture);
  find_silence(picture);
  return found_;
}

void HeightFinder::sort_pixels(const DepthPicture& picture) {
  const Eigen::Vector3f normal = found_.ground.normal.cast<float>();
  const auto offset = static_cast<float>(found_.ground.offset);
  const auto nearest = static_cast<float>(params_.nearest), reach = static_cast<float>(params_.reach);
  const auto low = static_cast<float>(params_.low), top = static_cast<float>(params_.robot_height);
  const auto drop = static_cast<float>(params_.drop), sigmas = static_cast<float>(params_.sigmas);
  const auto shaking = static_cast<float>(params_.tilt_sigma * std::numbers::pi / 180.0);
  const Eigen::Vector3d fall =
      camera_.base_from_camera().row(2);  // how much a ray goes up, for each of its coordinates
  for (int row = params_.edge; row < picture.rows - params_.edge; ++row) {
    const auto steepness = static_cast<float>(std::abs(fall.y() * (row - camera_.centre_y) / camera_.focal + fall.z()));
    const auto [across, upwards] = floor_strides(row);
    const std::size_t begin = picture.index(0, row);
    for (int column = params_.edge; column < picture.columns - params_.edge; ++column) {
      const std::size_t i = begin + static_cast<std::size_t>(column);
      const float depth = picture.depth[i];
      if (!(depth > nearest)) continue;
      const float height = normal.x() * points_.x[i] + normal.y() * points_.y[i] + normal.z() * points_.z[i] + offset;
      if (height >= top) continue;
      const float noise = sigmas * std::max(steepness * depth_noise(depth), shaking * depth);
      if (height > low + noise) {
        if (depth < reach) add_obstacle(picture, column, row, height);
      } else if (height < -drop - noise) {
        if (!is_flying(picture, column, row)) add_drop(i, height);
      } else if (depth < reach && row % upwards == 0 && column % across == 0) {
        found_.floor.push_back({points_.x[i], points_.y[i]});
      }
    }
  }
}

std::pair<int, int> HeightFinder::floor_strides(int row) const {
  constexpr double kApart = 0.015;  // [m] on the floor: some in each cell of 5 cm
  static constexpr int kMost = 8;   // [pixels]
  const double sinking = -camera_.ray(camera_.centre_x, row).z();
  if (!(sinking > 0.0)) return {1, 1};
  const double depth = camera_.mount.z / sinking;
  const double across = depth / camera_.focal, upwards = across * depth / camera_.mount.z;
  const auto stride = [](double pixel) -> int { return std::clamp(static_cast<int>(kApart / pixel), 1, kMost); };
  return {stride(across), stride(upwards)};
}

bool HeightFinder::is_flying(const DepthPicture& picture, int column, int row) const {
  const float depth = picture.depth[picture.index(column, row)];
  const float apart = static_cast<float>(params_.flying) * depth;
  const auto is_apart = [&](int x, int y) {
    const float other = picture.depth[picture.index(x, y)];
    return !(other > 0.0F) || std::abs(other - depth) > apart;
  };
  if (column < 1 || row < 1 || column + 1 >= picture.columns || row + 1 >= picture.rows) return true;
  return (is_apart(column - 1, row) && is_apart(column + 1, row)) ||
         (is_apart(column, row - 1) && is_apart(column, row + 1));
}

void HeightFinder::add_obstacle(const DepthPicture& picture, int column, int row, float height) {
  if (is_flying(picture, column, row)) return;
  const std::size_t i = picture.index(column, row);
  found_.points.push_back({points_.x[i], points_.y[i], height, HeightPoint::Kind::obstacle});
}

/// The place at which the ray ought to have met the floor.
void HeightFinder::add_drop(std::size_t pixel, float height) {
  const auto& mount = camera_.mount;
  const Eigen::Vector3d& normal = found_.ground.normal;
  const double above = normal.dot(camera_.position()) + found_.ground.offset;
  const double part = above / (above - static_cast<double>(height));  // of the way to what was seen
  const double x = mount.x + part * (static_cast<double>(points_.x[pixel]) - mount.x);
  const double y = mount.y + part * (static_cast<double>(points_.y[pixel]) - mount.y);
  const double away = std::hypot(x - mount.x, y - mount.y);
  if (away > params_.drop_reach) return;
  found_.points.push_back({static_cast<float>(x), static_cast<float>(y), height, HeightPoint::Kind::drop});
}

void HeightFinder::find_silence(const DepthPicture& picture) {
  const double above = found_.ground.normal.dot(camera_.position()) + found_.ground.offset;
  const int first = (params_.edge + kBlock - 1) / kBlock * kBlock;
  for (int row = first; row + kBlock + params_.edge <= picture.rows; row += kBlock) {
    for (int column = first; column + kBlock + params_.edge <= picture.columns; column += kBlock) {
      if (!is_silent(picture, column, row)) continue;
      const Eigen::Vector3d ray = camera_.ray(column + 0.5 * kBlock, row + 0.5 * kBlock);
      const double sinking = -found_.ground.normal.dot(ray);
      if (!(sinking * params_.floor_reach > above)) continue;
      const double depth = above / sinking;
      if (depth < params_.nearest) continue;
      // Beside a nearer thing the projector's light does not come, and at its edge nothing is measured.
      const int reach = static_cast<int>(params_.shadow / params_.nearest * picture.columns / 320.0);
      bool is_shadow = false;
      for (int x = std::max(0, column - reach); x < std::min(picture.columns, column + kBlock + reach); ++x) {
        const auto other = static_cast<double>(picture.depth[picture.index(x, row)]);
        if (!(other > 0.0) || other > depth * (1.0 - params_.flying)) continue;
        const double away = x < column ? column - x : x - column - kBlock + 1;
        is_shadow = is_shadow || away < 8 + params_.shadow * picture.columns / 320.0 * (1.0 / other - 1.0 / depth);
      }
      if (is_shadow) continue;
      const Eigen::Vector3d at = camera_.position() + depth * ray;
      found_.points.push_back(
          {static_cast<float>(at.x()), static_cast<float>(at.y()), 0.0F, HeightPoint::Kind::silent});
    }
  }
}

}  // namespace docent::vision
