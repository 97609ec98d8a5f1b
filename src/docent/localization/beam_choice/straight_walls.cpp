#include "docent/localization/beam_choice/straight_walls.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace docent::localization {
namespace {

constexpr double kDeviation = 0.06;       // [m] from the chord
constexpr double kGap = 0.5;              // [m] between neighbours, more is a break
constexpr std::size_t kFewestOnWall = 8;  // beams on a wall

/// Marks the straight parts of an unbroken run, splitting it where it is farthest from its chord.
void split(std::span<const Point2> run, double least_length, std::span<std::uint8_t> is_wall) {
  if (run.size() < kFewestOnWall) return;
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
    if (length >= least_length) std::fill(is_wall.begin(), is_wall.end(), std::uint8_t{1});
    return;
  }
  split(run.first(farthest + 1), least_length, is_wall.first(farthest + 1));
  split(run.subspan(farthest), least_length, is_wall.subspan(farthest));
}

}  // namespace

std::vector<std::uint8_t> on_straight_walls(const sensor_models::RangeSweep& sweep, double length) {
  const std::size_t size = sweep.beams.size();
  std::vector<std::uint8_t> is_wall(size, 0);
  std::vector<Point2> ends;
  ends.reserve(size);
  for (const sensor_models::SweepBeam& beam : sweep.beams) ends.push_back(sensor_models::endpoint(beam));
  const auto breaks_before = [&](std::size_t i) {
    const std::size_t before = (i + size - 1) % size;
    return sweep.beams[i].no_return || sweep.beams[before].no_return || distance(ends[i], ends[before]) > kGap;
  };
  // The sweep is closed: what its first and its last beam see may be one wall.
  std::size_t first = 0;
  while (first < size && !breaks_before(first)) ++first;
  first %= std::max<std::size_t>(size, 1);
  std::vector<Point2> run;
  std::vector<std::uint8_t> marks;
  for (std::size_t begin = 0; begin < size;) {
    run.clear();
    std::size_t end = begin;
    do {
      run.push_back(ends[(first + end) % size]);
      ++end;
    } while (end < size && !breaks_before((first + end) % size));
    marks.assign(run.size(), 0);
    split(run, length, marks);
    for (std::size_t i = 0; i < run.size(); ++i) is_wall[(first + begin + i) % size] = marks[i];
    begin = end;
  }
  return is_wall;
}

}  // namespace docent::localization
