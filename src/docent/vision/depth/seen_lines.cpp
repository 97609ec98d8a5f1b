#include "docent/vision/depth/seen_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace docent::vision {
namespace {

using Outline = std::vector<Point2>;

/// The nearest cell of each sector, in the order of bearings from behind round by the right.
std::vector<std::optional<Point2>> nearest_of(std::span<const LayerCell> cells, const Pose2& base_from_odom,
                                              bool is_drop, double cell_side, const SeenLinesParams& params) {
  const double sector = params.bearing * std::numbers::pi / 180.0;
  std::vector<std::optional<Point2>> nearest(static_cast<std::size_t>(std::ceil(2.0 * std::numbers::pi / sector)));
  for (const LayerCell& cell : cells) {
    if (cell.is_drop != is_drop) continue;
    const Point2 at = base_from_odom * cell.centre;
    const double away = norm(at);
    if (away > params.reach || away <= 0.0) continue;
    // Near cells are wider than a sector, and must not be seen through.
    const double half = std::atan2(0.5 * cell_side, away), bearing = std::atan2(at.y, at.x) + std::numbers::pi;
    const int first = static_cast<int>(std::floor((bearing - half) / sector));
    const int last = static_cast<int>(std::floor((bearing + half) / sector));
    const int sectors = static_cast<int>(nearest.size());
    for (int i = first; i <= last; ++i) {
      auto& here = nearest[static_cast<std::size_t>((i + sectors) % sectors)];
      if (!here || away < norm(*here)) here = at;
    }
  }
  return nearest;
}

std::vector<Outline> outlines_of(const std::vector<std::optional<Point2>>& nearest, double gap) {
  std::vector<Outline> outlines;
  for (const auto& at : nearest) {
    if (!at) continue;
    // Far off the sectors are wider apart than the cells.
    if (!outlines.empty() && outlines.back().back() == *at) continue;
    if (!outlines.empty() && distance(outlines.back().back(), *at) <= gap)
      outlines.back().push_back(*at);
    else
      outlines.push_back({*at});
  }
  return outlines;
}

/// Cuts an outline where it bends most, until all parts are straight (Douglas and Peucker).
void cut(const Outline& outline, std::size_t first, std::size_t last, double straight, std::vector<Segment>& lines) {
  double most = 0.0;
  std::size_t bend = first;
  const Segment whole{outline[first], outline[last]};
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = distance(whole, outline[i]);
    if (off <= most) continue;
    most = off;
    bend = i;
  }
  if (most <= straight) {
    lines.push_back(whole);
    return;
  }
  cut(outline, first, bend, straight, lines);
  cut(outline, bend, last, straight, lines);
}

SeenLine with_deviation(const Segment& line, bool is_drop, double cell, double camera_height,
                        const SeenLinesParams& params) {
  const double away = distance(line, {0.0, 0.0});
  const auto noise = static_cast<double>(depth_noise(static_cast<float>(away)));
  const double shaking =
      (away * away + camera_height * camera_height) / camera_height * params.tilt * std::numbers::pi / 180.0;
  // Of the shaking only what depth does not say: things are placed by depth, drops by where the ray meets the floor.
  const double radial = is_drop ? shaking : 0.5 * shaking;
  const double of_cell = cell * cell / 12.0;
  const double tangential = away * params.tilt * std::numbers::pi / 180.0;
  const Point2 middle = 0.5 * (line.a + line.b), along = line.b - line.a;
  const double length = norm(along), reach = norm(middle);
  // How much of the line's normal points away from the robot.
  const double facing = length > 0.0 && reach > 0.0 ? std::abs(cross(along, middle)) / (length * reach) : 1.0;
  const double deep = noise * noise + radial * radial, wide = tangential * tangential;
  const double across = facing * facing * deep + (1.0 - facing * facing) * wide + of_cell;
  const double lengthways = (1.0 - facing * facing) * deep + facing * facing * wide + of_cell;
  return {line, is_drop, std::sqrt(across), std::sqrt(lengthways)};
}

}  // namespace

Result<void> SeenLinesParams::validate() const {
  if (!(bearing > 0.0 && bearing <= 30.0)) return fail("seen lines: bearing must be in (0, 30]");
  if (!(gap > 0.0 && straight > 0.0 && reach > 0.0)) return fail("seen lines: gap, straight and reach must be > 0");
  if (!(tilt >= 0.0)) return fail("seen lines: tilt must be >= 0");
  if (!(most >= 1)) return fail("seen lines: most must be >= 1");
  return {};
}

std::vector<SeenLine> lines_of(std::span<const LayerCell> cells, const Pose2& odom_from_base, double cell,
                               double camera_height, const SeenLinesParams& params) {
  const Pose2 base_from_odom = inverse(odom_from_base);
  std::vector<SeenLine> seen;
  for (const bool is_drop : {false, true}) {
    std::vector<Segment> lines;
    for (const Outline& outline : outlines_of(nearest_of(cells, base_from_odom, is_drop, cell, params), params.gap))
      cut(outline, 0, outline.size() - 1, params.straight, lines);
    for (const Segment& line : lines) seen.push_back(with_deviation(line, is_drop, cell, camera_height, params));
  }
  std::stable_sort(seen.begin(), seen.end(), [](const SeenLine& a, const SeenLine& b) {
    return distance(a.line, {0.0, 0.0}) < distance(b.line, {0.0, 0.0});
  });
  if (seen.size() > static_cast<std::size_t>(params.most)) seen.resize(static_cast<std::size_t>(params.most));
  return seen;
}

}  // namespace docent::vision
