#include "docent/vision/things/floor_things.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::vision {
namespace {

/// @param at  0..1; reorders the values
float quantile_of(std::vector<float>& values, double at) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(at * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Result<void> FloorThingParams::validate() const {
  if (!(low > 0.0)) return fail("things: low must be > 0");
  if (!(least > 0.0 && most > least)) return fail("things: 0 < least < most");
  if (!(foot > 0.0 && gap > 0.0 && reach > 0.0)) return fail("things: foot, gap and reach must be > 0");
  if (!(sigmas >= 0.0) || least_pixels < 1 || border < 0)
    return fail("things: sigmas and border must be >= 0, least_pixels >= 1");
  return {};
}

FloorThingFinder::FloorThingFinder(const DepthCamera& camera, const FloorThingParams& params)
    : camera_{camera}, projector_{camera}, params_{params} {}

FloorView FloorThingFinder::find(const DepthPicture& picture, Rng& rng) {
  points_.fill(camera_, picture);
  ground_ = find_ground_plane(picture, points_, {}, rng);
  if (!ground_.is_seen) {
    kinds_.clear();
    return {};
  }
  sort_pixels(picture);
  return {true, clusters(picture)};
}

void FloorThingFinder::sort_pixels(const DepthPicture& picture) {
  const std::size_t count = picture.depth.size();
  heights_.assign(count, 0.0F);
  kinds_.assign(count, Kind::unknown);
  const Eigen::Vector3f up = ground_.normal.cast<float>();
  const auto offset = static_cast<float>(ground_.offset), low = static_cast<float>(params_.low),
             sigmas = static_cast<float>(params_.sigmas);
  for (std::size_t i = 0; i < count; ++i) {
    const float depth = picture.depth[i];
    if (!(depth > 0.0F)) continue;
    const float height = up.x() * points_.x[i] + up.y() * points_.y[i] + up.z() * points_.z[i] + offset;
    // What noise along the axis does to a height: less, the flatter the ray.
    const float steep = std::max(0.2F, (static_cast<float>(camera_.mount.z) - height) / depth);
    const float bound = low + sigmas * steep * depth_noise(depth);
    heights_[i] = height;
    kinds_[i] = height > bound ? Kind::raised : height > -bound ? Kind::floor : Kind::unknown;
  }
}

std::vector<FloorThing> FloorThingFinder::clusters(const DepthPicture& picture) {
  std::vector<FloorThing> things;
  std::vector<bool> is_taken(kinds_.size(), false);
  std::vector<int> cluster, open;
  const int columns = picture.columns, rows = picture.rows;
  const auto gap = static_cast<float>(params_.gap);
  for (int first = 0; first < columns * rows; ++first) {
    if (kinds_[static_cast<std::size_t>(first)] != Kind::raised || is_taken[static_cast<std::size_t>(first)]) continue;
    cluster.clear();
    open.assign(1, first);
    is_taken[static_cast<std::size_t>(first)] = true;
    bool is_whole = true;
    while (!open.empty()) {
      const int pixel = open.back();
      open.pop_back();
      cluster.push_back(pixel);
      const int column = pixel % columns, row = pixel / columns;
      const int edge = std::min(std::min(column, columns - 1 - column), std::min(row, rows - 1 - row));
      is_whole = is_whole && edge >= params_.border;
      const float depth = picture.depth[static_cast<std::size_t>(pixel)];
      for (const auto& [dx, dy] : std::array<std::array<int, 2>, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
        if (column + dx < 0 || column + dx >= columns || row + dy < 0 || row + dy >= rows) continue;
        const auto other = static_cast<std::size_t>(pixel + dx + dy * columns);
        if (is_taken[other] || kinds_[other] != Kind::raised) continue;
        if (std::abs(picture.depth[other] - depth) > gap) continue;
        is_taken[other] = true;
        open.push_back(static_cast<int>(other));
      }
    }
    FloorThing thing;
    if (is_whole && static_cast<int>(cluster.size()) >= params_.least_pixels && measure(cluster, thing))
      things.push_back(thing);
  }
  std::sort(things.begin(), things.end(),
            [](const FloorThing& a, const FloorThing& b) { return norm(a.middle) < norm(b.middle); });
  return things;
}

bool FloorThingFinder::measure(const std::vector<int>& pixels, FloorThing& thing) const {
  constexpr double kFew = 0.05;  // of the pixels at each side are left out: they mix with what lies behind
  const Point2 eye{camera_.mount.x, camera_.mount.y};
  Point2 sum;
  std::vector<float> heights, along, across;
  for (const int pixel : pixels) {
    const auto i = static_cast<std::size_t>(pixel);
    sum = sum + Point2{static_cast<double>(points_.x[i]), static_cast<double>(points_.y[i])};
    heights.push_back(heights_[i]);
  }
  const Point2 mean = (1.0 / static_cast<double>(pixels.size())) * sum;
  const Point2 ahead = unit(direction(eye, mean)), left{-ahead.y, ahead.x};
  for (const int pixel : pixels) {
    const auto i = static_cast<std::size_t>(pixel);
    const Point2 off = Point2{static_cast<double>(points_.x[i]), static_cast<double>(points_.y[i])} - eye;
    along.push_back(static_cast<float>(dot(off, ahead)));
    across.push_back(static_cast<float>(dot(off, left)));
  }
  const double near = static_cast<double>(quantile_of(along, kFew)),
               far = static_cast<double>(quantile_of(along, 1.0 - kFew));
  const double right = static_cast<double>(quantile_of(across, kFew));
  const double outer = static_cast<double>(quantile_of(across, 1.0 - kFew));
  const double pixel_size = near / camera_.focal;
  thing.width = outer - right + pixel_size;
  thing.height = static_cast<double>(quantile_of(heights, 1.0 - 0.5 * kFew));
  thing.pixels = static_cast<int>(pixels.size());
  if (static_cast<double>(quantile_of(heights, kFew)) > params_.foot) return false;
  if (std::max(thing.width, thing.height) < params_.least) return false;
  if (std::max(thing.width, thing.height) > params_.most || far - near > params_.most) return false;
  const double reach_along = near + 0.5 * thing.width;
  thing.middle = eye + reach_along * ahead + 0.5 * (right + outer) * left;
  if (norm(thing.middle) > params_.reach) return false;
  // Along the sight the far half is a guess; across it counts how surely the camera's mount is known.
  const double sight = 0.015 + 0.01 * reach_along, side = 0.008 + 0.008 * reach_along;
  Eigen::Matrix2d turn;
  turn << ahead.x, left.x, ahead.y, left.y;
  thing.covariance = turn * Eigen::Vector2d{sight * sight, side * side}.asDiagonal() * turn.transpose();
  return true;
}

bool FloorThingFinder::is_bare(Point2 in_base, double radius) const {
  if (kinds_.empty()) return false;
  constexpr int kSteps = 2;  // each way
  int floor = 0, other = 0;
  for (int dx = -kSteps; dx <= kSteps; ++dx) {
    for (int dy = -kSteps; dy <= kSteps; ++dy) {
      const Eigen::Vector3d point{in_base.x + radius * dx / kSteps, in_base.y + radius * dy / kSteps, 0.0};
      const auto place = projector_.place_of(point);
      if (!place) return false;
      const auto column = static_cast<int>(std::lround(place->column)), row = static_cast<int>(std::lround(place->row));
      const int edge = std::min(std::min(column, camera_.columns - 1 - column), std::min(row, camera_.rows - 1 - row));
      if (edge < 2 * params_.border) return false;
      const Kind kind = kinds_[static_cast<std::size_t>(row) * static_cast<std::size_t>(camera_.columns) +
                               static_cast<std::size_t>(column)];
      ++(kind == Kind::floor ? floor : other);
    }
  }
  return other * 5 <= floor;
}

}  // namespace docent::vision
