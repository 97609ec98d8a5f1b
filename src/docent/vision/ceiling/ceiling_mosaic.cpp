#include "docent/vision/ceiling/ceiling_mosaic.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr int kBoxes = 3;  // as many box filters one after the other are all but a Gaussian

/// Sums of 2 radius + 1 values along lines, in place. @param step  from one value of a line to the next
void add_up(std::vector<float>& values, std::size_t lines, std::size_t line_step, std::size_t length, std::size_t step,
            int radius) {
  std::vector<float> line(length);
  for (std::size_t i = 0; i < lines; ++i) {
    float* first = values.data() + i * line_step;
    for (std::size_t k = 0; k < length; ++k) line[k] = first[k * step];
    const auto reach = static_cast<std::size_t>(radius);
    double sum = 0.0;
    for (std::size_t k = 0; k < std::min(reach, length); ++k) sum += static_cast<double>(line[k]);
    for (std::size_t k = 0; k < length; ++k) {
      if (k + reach < length) sum += static_cast<double>(line[k + reach]);
      if (k > reach) sum -= static_cast<double>(line[k - reach - 1]);
      first[k * step] = static_cast<float>(sum);
    }
  }
}

void blur_in_place(std::vector<float>& values, const GridFrame& frame, int radius) {
  const auto columns = static_cast<std::size_t>(frame.columns), rows = static_cast<std::size_t>(frame.rows);
  const float share = 1.0F / static_cast<float>((2 * radius + 1) * (2 * radius + 1));
  for (int i = 0; i < kBoxes; ++i) {
    add_up(values, rows, columns, columns, 1, radius);
    add_up(values, columns, 1, rows, columns, radius);
    for (float& value : values) value *= share;
  }
}

/// With cells `factor` times as long: the part of the middle one, and the mean of those of it.
CeilingMosaic coarser(const CeilingMosaic& mosaic, int factor) {
  if (factor == 1) return mosaic;
  CeilingMosaic coarse{mosaic.frame, mosaic.heights, {}, {}};
  coarse.frame.columns = std::max(2, mosaic.frame.columns / factor);
  coarse.frame.rows = std::max(2, mosaic.frame.rows / factor);
  coarse.frame.resolution *= factor;
  coarse.part.assign(coarse.frame.size(), CeilingMosaic::kUnknown);
  coarse.brightness.assign(coarse.frame.size(), 0.0F);
  for (int row = 0; row < mosaic.frame.rows / factor; ++row) {
    for (int column = 0; column < mosaic.frame.columns / factor; ++column) {
      const std::uint8_t part =
          mosaic.part[mosaic.frame.index({column * factor + factor / 2, row * factor + factor / 2})];
      if (part == CeilingMosaic::kUnknown) continue;
      float sum = 0.0F, count = 0.0F;
      for (int v = 0; v < factor; ++v)
        for (int u = 0; u < factor; ++u) {
          const std::size_t cell = mosaic.frame.index({column * factor + u, row * factor + v});
          if (mosaic.part[cell] == part) sum += mosaic.brightness[cell], count += 1.0F;
        }
      const std::size_t cell = coarse.frame.index({column, row});
      coarse.part[cell] = part;
      coarse.brightness[cell] = sum / count;
    }
  }
  return coarse;
}

/// Cells a third of the blur long lose nothing.
int factor_of(const CeilingMosaic& mosaic, double blur) {
  const int most = std::max(1, std::min(mosaic.frame.columns, mosaic.frame.rows) / 4);
  return std::clamp(static_cast<int>(blur / (3.0 * mosaic.frame.resolution)), 1, most);
}

}  // namespace

bool is_visible(const CeilingMosaic& mosaic, Point2 lens_in_map, double lens_height, Point2 in_map, std::size_t part) {
  for (std::size_t lower = 0; lower < mosaic.heights.size(); ++lower) {
    if (mosaic.heights[lower] >= mosaic.heights[part]) continue;
    const double share = (mosaic.heights[lower] - lens_height) / (mosaic.heights[part] - lens_height);
    const CellIndex through = mosaic.frame.cell_at(lens_in_map + share * (in_map - lens_in_map));
    if (!mosaic.frame.holds(through)) continue;
    const std::uint8_t at = mosaic.part[mosaic.frame.index(through)];
    if (at != CeilingMosaic::kUnknown && mosaic.heights[at] <= mosaic.heights[lower]) return false;
  }
  return true;
}

MosaicLevel::MosaicLevel(const CeilingMosaic& mosaic, double blur)
    : MosaicLevel{coarser(mosaic, factor_of(mosaic, blur)), blur, Own{}} {}

MosaicLevel::MosaicLevel(const CeilingMosaic& mosaic, double blur, Own)
    : frame_{mosaic.frame},
      heights_{mosaic.heights},
      blur_{blur},
      per_metre_{1.0 / mosaic.frame.resolution},
      last_column_{static_cast<double>(mosaic.frame.columns - 1)},
      last_row_{static_cast<double>(mosaic.frame.rows - 1)},
      cells_(mosaic.frame.size()),
      whole_(mosaic.frame.size(), CeilingMosaic::kUnknown) {
  DOCENT_CHECK(mosaic.part.size() == frame_.size() && mosaic.brightness.size() == frame_.size());
  // Variance of `kBoxes` boxes of 2 r + 1 cells: kBoxes ((2 r + 1)^2 - 1) / 12.
  const double cells = blur / frame_.resolution;
  const int radius = static_cast<int>(std::lround(0.5 * (std::sqrt(1.0 + 12.0 * cells * cells / kBoxes) - 1.0)));
  std::vector<float> values(frame_.size()), weights(frame_.size());
  for (std::size_t part = 0; part < heights_.size(); ++part) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      weights[i] = mosaic.part[i] == part ? 1.0F : 0.0F;
      values[i] = weights[i] * mosaic.brightness[i];
    }
    if (radius > 0) {
      blur_in_place(values, frame_, radius);
      blur_in_place(weights, frame_, radius);
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      if (mosaic.part[i] == part) cells_[i].brightness = values[i] / std::max(weights[i], 1e-6F);
  }
  const auto columns = static_cast<std::size_t>(frame_.columns);
  const auto at = [&](std::size_t i) { return mosaic.part[i]; };
  for (std::size_t row = 0; row < static_cast<std::size_t>(frame_.rows); ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t i = row * columns + column;
      if (at(i) == CeilingMosaic::kUnknown) continue;
      // Central differences where both sides are of the same part, else one-sided ones.
      const auto slope = [&](bool has_before, std::size_t before, bool has_after, std::size_t after) {
        const std::size_t from = has_before && at(before) == at(i) ? before : i;
        const std::size_t to = has_after && at(after) == at(i) ? after : i;
        const float steps = (from != i ? 1.0F : 0.0F) + (to != i ? 1.0F : 0.0F);
        if (steps == 0.0F) return 0.0F;
        return (cells_[to].brightness - cells_[from].brightness) * static_cast<float>(per_metre_) / steps;
      };
      const bool has_right = column + 1 < columns, has_upper = row + 1 < static_cast<std::size_t>(frame_.rows);
      cells_[i].by_x = slope(column > 0, i - 1, has_right, i + 1);
      cells_[i].by_y = slope(row > 0, i - columns, has_upper, i + columns);
      if (has_right && has_upper && at(i + 1) == at(i) && at(i + columns) == at(i) && at(i + columns + 1) == at(i))
        whole_[i] = at(i);
    }
  }
}

MosaicPyramid pyramid_of(const CeilingMosaic& mosaic, const std::vector<double>& blurs) {
  MosaicPyramid levels;
  levels.reserve(blurs.size());
  for (const double blur : blurs) levels.emplace_back(mosaic, blur);
  return levels;
}

}  // namespace docent::vision
