#include "docent/collision_avoidance/plausibility/blind_sectors.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {
namespace {

bool is_silent(const SweepView& view, std::size_t sample) { return view.ranges[sample] == kNoAnswer; }

/// Whether at least `share` of the samples that answer, and `least` of them, do so within `noise` [m] of what is
/// expected.
bool is_rest_as_expected(const SweepView& view, std::span<const float> expected, double share, int least,
                         double noise) {
  int answers = 0;
  int as_expected = 0;
  for (std::size_t i = 0; i < view.ranges.size(); ++i) {
    if (!view.met(i) || !(expected[i] < kNoAnswer)) continue;
    ++answers;
    const bool is_between = expected[i] >= view.nearest[i] - noise && expected[i] <= view.farthest[i] + noise;
    as_expected += is_between ? 1 : 0;
  }
  return answers >= least && as_expected >= share * answers;
}

}  // namespace

void BlindSectors::follow(const SweepView& view) {
  if (view.ranges.size() != samples_) forget();
  samples_ = view.ranges.size();
  std::erase_if(sectors_, [&](Sector& sector) {
    std::size_t answers = 0;
    for (std::size_t i = sector.run.first; i < sector.run.end; ++i) answers += view.met(i) ? 1 : 0;
    const bool is_open =
        static_cast<double>(answers) >= params_.opened * static_cast<double>(sector.run.end - sector.run.first);
    sector.opened = is_open ? sector.opened + 1 : 0;
    if (!is_open) ++sector.sweeps;
    return sector.opened >= (sector.sweeps < params_.sure ? 1 : params_.sure);
  });
}

void BlindSectors::look_for(const SweepView& view, std::span<const float> expected, double elapsed,
                            double hole_of_walls) {
  const auto is_known = [&](std::size_t i) {
    return expected[i] < params_.surely_within * view.max_range;  // false for NaN
  };
  if (!is_rest_as_expected(view, expected, params_.rest, params_.least_rest, params_.noise)) return;
  const auto widest_hole = static_cast<int>(std::lround(std::max(params_.hole, hole_of_walls) / view.bearing_step));
  const double least_arc = params_.least_arc + params_.people * elapsed;
  for (std::size_t i = 0; i < view.ranges.size();) {
    if (!is_silent(view, i)) {
      ++i;
      continue;
    }
    const std::size_t first = i;
    double arc = 0.0;
    double angle = 0.0;
    double known_angle = 0.0;
    int hole = widest_hole + 1;
    // The widest part of the silence in which, but for small holes, something was expected.
    double widest_arc = 0.0;
    double widest_angle = 0.0;
    for (; i < view.ranges.size() && is_silent(view, i); ++i) {
      if (is_known(i)) {
        arc += static_cast<double>(expected[i]) * view.bearing_step;
        known_angle += view.bearing_step;
        hole = 0;
      } else if (++hole > widest_hole) {
        arc = angle = known_angle = 0.0;
        continue;
      } else if (hole_of_walls > 0.0) {
        continue;  // whoever hid the wall there may have left
      }
      angle += view.bearing_step;
      if (known_angle >= params_.least_known * angle && arc > widest_arc) {
        widest_arc = arc;
        widest_angle = angle;
      }
    }
    if (widest_angle < params_.least_angle || widest_arc < least_arc) continue;
    add(view, {first, i});
    // A wall that was turned into the sector met a silence that was there before.
    if (hole_of_walls > 0.0)
      for (Sector& sector : sectors_)
        if (sector.run.first < i && first < sector.run.end) sector.sweeps = std::max(sector.sweeps, 1);
  }
}

void BlindSectors::add(const SweepView& view, BeamRun run) {
  samples_ = view.ranges.size();
  for (Sector& sector : sectors_) {
    if (run.first >= sector.run.end || sector.run.first >= run.end) continue;
    sector.run.first = std::min(sector.run.first, run.first);
    sector.run.end = std::max(sector.run.end, run.end);
    return;
  }
  sectors_.push_back({run, 0, 0});
}

void BlindSectors::forget_newest() {
  std::erase_if(sectors_, [&](const Sector& sector) { return sector.sweeps <= params_.sure; });
}

std::vector<BeamRun> BlindSectors::runs() const {
  std::vector<BeamRun> runs;
  for (const Sector& sector : sectors_) runs.push_back(sector.run);
  return runs;
}

bool BlindSectors::is_any_sure() const {
  return std::any_of(sectors_.begin(), sectors_.end(),
                     [&](const Sector& sector) { return sector.sweeps >= params_.sure; });
}

}  // namespace docent::collision_avoidance
