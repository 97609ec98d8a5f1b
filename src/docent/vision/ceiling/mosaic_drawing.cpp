#include "docent/vision/ceiling/mosaic_drawing.h"

#include <algorithm>
#include <cmath>

namespace docent::vision {
namespace {

constexpr float kLeastWeight = 0.02F;  // of a cell that was seen at all: one look from far aside

/// Share of lo .. hi that lies within half a length of a multiple of `step`. Lamps do not overlap.
double covered(double lo, double hi, double step, double length) {
  const double nearest = step * std::round(0.5 * (lo + hi) / step);
  return std::clamp((std::min(hi, nearest + 0.5 * length) - std::max(lo, nearest - 0.5 * length)) / (hi - lo), 0.0,
                    1.0);
}

}  // namespace

MosaicDrawing::MosaicDrawing(CeilingMosaic mosaic, const CeilingCamera& camera, double steepest)
    : parts_{std::move(mosaic)},
      camera_{camera},
      steepest_{steepest},
      sums_(parts_.frame.size()),
      weights_(parts_.frame.size()) {}

void MosaicDrawing::add(const PlacedPicture& placed) {
  const GridFrame& frame = parts_.frame;
  const Pose2 robot_from_map = inverse(placed.map_from_robot);
  const Point2 lens_in_map = placed.map_from_robot * Point2{camera_.mount.position.x(), camera_.mount.position.y()};
  double highest = 0.0;
  for (const double height : parts_.heights) highest = std::max(highest, height - camera_.mount.position.z());
  const double reach = steepest_ * highest;
  const CellIndex first = frame.cell_at(lens_in_map - Point2{reach, reach});
  const CellIndex last = frame.cell_at(lens_in_map + Point2{reach, reach});
  const auto width = static_cast<std::size_t>(placed.picture.columns);
  for (int row = std::max(0, first.row); row <= std::min(frame.rows - 1, last.row); ++row) {
    for (int column = std::max(0, first.column); column <= std::min(frame.columns - 1, last.column); ++column) {
      const std::size_t cell = frame.index({column, row});
      const std::uint8_t part = parts_.part[cell];
      if (part == CeilingMosaic::kUnknown) continue;
      const Point2 centre = frame.centre({column, row});
      const double above = parts_.heights[part] - camera_.mount.position.z();
      const double slope = distance(centre, lens_in_map) / above;
      if (slope > steepest_) continue;
      const auto pixel = camera_.pixel_of(robot_from_map * centre, parts_.heights[part]);
      if (!pixel || !(pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() < placed.picture.columns - 1.0 &&
                      pixel->y() < placed.picture.rows - 1.0))
        continue;
      const auto x = static_cast<std::size_t>(pixel->x()), y = static_cast<std::size_t>(pixel->y());
      const double u = pixel->x() - static_cast<double>(x), v = pixel->y() - static_cast<double>(y);
      const std::uint8_t* at = placed.picture.bytes.data() + y * width + x;
      const double value =
          ((1.0 - v) * ((1.0 - u) * at[0] + u * at[1]) + v * ((1.0 - u) * at[width] + u * at[width + 1])) / 255.0;
      // A pixel that looks at a slope s sees (1 + s^2)^(3/2) times the area, and so less of a cell.
      const double weight = std::pow(1.0 + slope * slope, -1.5);
      sums_[cell] += static_cast<float>(weight * (value - placed.offset) / placed.gain);
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
