#include "docent/localization/belief/straight_walls.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace docent {
namespace {

constexpr double kLength = 1.5;      // [m]
constexpr double kDeviation = 0.06;  // [m] from the chord
constexpr double kGap = 0.5;         // [m] between neighbours, more is a break
constexpr std::size_t kBeams = 8;

/// Marks the straight parts of an unbroken run, splitting it where it is farthest from its chord.
void split(std::span<const Point2> run, std::span<std::uint8_t> is_wall) {
  if (run.size() < kBeams) return;
  const Point2 chord = run.back() - run.front();
  const double length = norm(chord);
  std::size_t farthest = 0;
  double deviation = 0.0;
  for (std::size_t i = 1; i + 1 < run.size(); ++i) {
    const Point2 off = run[i] - run.front();
    const double away = length > 1e-6 ? std::abs(cross(chord, off)) / length : norm(off);
    if (away > deviation) {
      deviation = away;
      farthest = i;
    }
  }
  if (deviation <= kDeviation) {
    if (length >= kLength) std::fill(is_wall.begin(), is_wall.end(), std::uint8_t{1});
    return;
  }
  split(run.first(farthest + 1), is_wall.first(farthest + 1));
  split(run.subspan(farthest), is_wall.subspan(farthest));
}

}  // namespace

std::vector<std::uint8_t> on_straight_walls(const RangeSweep& sweep) {
  std::vector<Point2> points(sweep.beams.size());
  std::vector<std::uint8_t> is_wall(sweep.beams.size(), 0);
  const std::span<std::uint8_t> marks{is_wall};
  const std::span<const Point2> all{points};
  std::size_t begin = 0;
  for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
    const bool is_end = sweep.beams[i].no_return;
    points[i] = endpoint(sweep.beams[i]);
    if (i > begin && (is_end || norm(points[i] - points[i - 1]) > kGap)) {
      split(all.subspan(begin, i - begin), marks.subspan(begin, i - begin));
      begin = i;
    }
    if (is_end) begin = i + 1;
  }
  if (begin < points.size()) split(all.subspan(begin), marks.subspan(begin));
  return is_wall;
}

}  // namespace docent
