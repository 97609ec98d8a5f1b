#include "docent/vision/ceiling/mosaic_drawing.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace docent::vision {
namespace {

constexpr float kLeastWeight = 0.02F;  // of a cell that was seen at all: one look from far aside

/// Share of lo .. hi that lies within half a length of a multiple of `step`. Lamps do not overlap.
double covered(double lo, double hi, double step, double length) {
  const double nearest = step * std::round(0.5 * (lo + hi) / step);
  return std::clamp((std::min(hi, nearest + 0.5 * length) - std::max(lo, nearest - 0.5 * length)) / (hi - lo), 0.0,
                    1.0);
}

/// Of 0 .. 1; nothing outside.
std::optional<double> between_pixels(const GrayPicture& picture, const Eigen::Vector2d& at) {
  if (!(at.x() >= 0.0 && at.y() >= 0.0 && at.x() < picture.columns - 1.0 && at.y() < picture.rows - 1.0))
    return std::nullopt;
  const auto x = static_cast<std::size_t>(at.x()), y = static_cast<std::size_t>(at.y());
  const double u = at.x() - static_cast<double>(x), v = at.y() - static_cast<double>(y);
  const auto width = static_cast<std::size_t>(picture.columns);
  const std::uint8_t* pixel = picture.bytes.data() + y * width + x;
  return ((1.0 - v) * ((1.0 - u) * pixel[0] + u * pixel[1]) + v * ((1.0 - u) * pixel[width] + u * pixel[width + 1])) /
         255.0;
}

}  // namespace

MosaicDrawing::MosaicDrawing(CeilingMosaic mosaic, const CeilingCamera& camera, double steepest)
    : parts_{std::move(mosaic)},
      camera_{camera},
      steepest_{steepest},
      sums_(parts_.frame.size()),
      weights_(parts_.frame.size()) {}

void MosaicDrawing::add(const PlacedPicture& placed) {
  for (std::size_t part = 0; part < parts_.heights.size(); ++part) add_part(placed, part);
}

void MosaicDrawing::add_part(const PlacedPicture& placed, std::size_t part) {
  const GridFrame& frame = parts_.frame;
  const Pose2 robot_from_map = inverse(placed.map_from_robot);
  const Point2 lens = placed.map_from_robot * Point2{camera_.mount.position.x(), camera_.mount.position.y()};
  const double height = parts_.heights[part], above = height - camera_.mount.position.z();
  const double reach = steepest_ * above;
  const CellIndex first = frame.cell_at(lens - Point2{reach, reach}), last = frame.cell_at(lens + Point2{reach, reach});
  for (int row = std::max(0, first.row); row <= std::min(frame.rows - 1, last.row); ++row) {
    for (int column = std::max(0, first.column); column <= std::min(frame.columns - 1, last.column); ++column) {
      const std::size_t cell = frame.index({column, row});
      if (parts_.part[cell] != part) continue;
      const Point2 centre = frame.centre({column, row}), away = centre - lens;
      if (dot(away, away) > reach * reach || !is_visible(parts_, lens, camera_.mount.position.z(), centre, part))
        continue;
      const auto pixel = camera_.pixel_of(robot_from_map * centre, height);
      const auto value = pixel ? between_pixels(placed.picture, *pixel) : std::nullopt;
      if (!value) continue;
      // A pixel that looks at a slope s sees (1 + s^2)^(3/2) times the area, and so less of a cell.
      const double longer = 1.0 + dot(away, away) / (above * above);
      const double weight = 1.0 / (longer * std::sqrt(longer));
      sums_[cell] += static_cast<float>(weight * (*value - placed.offset) / placed.gain);
      weights_[cell] += static_cast<float>(weight);
    }
  }
}

CeilingMosaic MosaicDrawing::mosaic() const {
  CeilingMosaic mosaic = parts_;
  mosaic.brightness.assign(mosaic.frame.size(), 0.0F);
  for (std::size_t i = 0; i < mosaic.part.size(); ++i) {
    if (weights_[i] >= kLeastWeight) {
      mosaic.brightness[i] = sums_[i] / weights_[i];
    } else {
      mosaic.part[i] = CeilingMosaic::kUnknown;
    }
  }
  return mosaic;
}

CeilingMosaic mosaic_of(const LampGrid& lamps, const GridFrame& frame) {
  CeilingMosaic mosaic{
      frame, {lamps.height}, std::vector<std::uint8_t>(frame.size()), std::vector<float>(frame.size())};
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const Point2 centre = frame.centre({column, row});
      const double half = 0.5 * frame.resolution;
      mosaic.brightness[frame.index({column, row})] =
          static_cast<float>(covered(centre.x - half, centre.x + half, lamps.step_x, lamps.length_x) *
                             covered(centre.y - half, centre.y + half, lamps.step_y, lamps.length_y));
    }
  }
  return mosaic;
}

}  // namespace docent::vision
