#include "docent/collision_avoidance/plausibility/near_things.h"

#include <algorithm>
#include <cmath>

#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"
#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {

void NearThings::revise(const SweepView& view) {
  const PointTransform sensor_from_odom{inverse(view.odom_from_sensor)};
  std::erase_if(places_, [&](Place& place) {
    if (view.stamp - place.since > seconds(params_.longest)) return true;
    const Point2 at = sensor_from_odom * place.in_odom;
    const long sample = view.sample_to(at);
    if (sample < 0) return false;
    const auto i = static_cast<std::size_t>(sample);
    const bool should_be_seen = norm(at) > nearest(view) + params_.goes;
    const bool is_looked_past = view.met(i) && view.ranges[i] > norm(at);
    if (view.met(i) || should_be_seen) {
      return (is_looked_past || should_be_seen) && ++place.missed >= params_.sure;
    }
    place.missed = 0;
    return false;
  });
}

void NearThings::note_nearest(const SweepView& view) {
  std::erase_if(nearest_, [&](const Nearest& one) { return view.stamp - one.stamp > seconds(params_.proves); });
  std::vector<float> met;
  for (std::size_t i = 0; i < view.ranges.size(); ++i)
    if (view.met(i) && view.ranges[i] < static_cast<float>(params_.within)) met.push_back(view.ranges[i]);
  const auto several = static_cast<std::ptrdiff_t>(params_.several);
  if (std::ssize(met) < several) return;
  std::nth_element(met.begin(), met.begin() + several - 1, met.end());
  const auto range = static_cast<double>(met[static_cast<std::size_t>(several - 1)]);
  // Of readings that are farther and older nothing more is to be learned.
  std::erase_if(nearest_, [&](const Nearest& one) { return one.range >= range; });
  nearest_.push_back({view.stamp, range});
  if (!has_seen_nearer_than(blind_within_ - params_.alike)) return;
  blind_within_ = 0.0;
  gaps_ = 0;
  places_.clear();
}

bool NearThings::has_seen_nearer_than(double range) const {
  return std::any_of(nearest_.begin(), nearest_.end(), [&](const Nearest& one) { return one.range < range; });
}

bool NearThings::find_gaps(const SweepView& view, std::span<const float> expected, std::vector<Point2>& gone) {
  const std::size_t samples = view.ranges.size();
  bool found = false;
  for (std::size_t i = 1; i < samples;) {
    if (view.ranges[i] != kNoAnswer) {
      ++i;
      continue;
    }
    const std::size_t first = i;
    while (i < samples && view.ranges[i] == kNoAnswer) ++i;
    if (i - first < static_cast<std::size_t>(params_.several) || i == samples || !view.met(first - 1) || !view.met(i))
      continue;
    const auto [nearer, flank] =
        std::minmax({static_cast<double>(view.ranges[first - 1]), static_cast<double>(view.ranges[i])});
    // A scanner that is blind within some distance loses a thing's middle and keeps both sides, from that distance on.
    // Two people between whom somebody has left are seldom as far.
    if (flank > params_.within || flank - nearer > params_.alike) continue;
    if (has_seen_nearer_than(nearer - params_.alike)) continue;
    std::vector<Point2> in_gap;
    for (std::size_t k = first; k < i; ++k) {
      if (!(static_cast<double>(expected[k]) <= flank + params_.flank)) continue;
      const Angle bearing = Angle::radians(view.first_bearing + static_cast<double>(k) * view.bearing_step);
      in_gap.push_back(view.odom_from_sensor * (static_cast<double>(expected[k]) * unit(bearing)));
    }
    if (static_cast<double>(in_gap.size()) < params_.gap_known * static_cast<double>(i - first)) continue;
    found = true;
    if (gaps_ >= 1 && std::abs(flank - last_flank_) <= params_.alike) blind_within_ = std::max(blind_within_, flank);
    last_flank_ = flank;
    gone.insert(gone.end(), in_gap.begin(), in_gap.end());
  }
  return found;
}

void NearThings::hold(const SweepView& view, std::span<const Point2> gone) {
  for (const Point2 in_odom : gone) {
    const bool is_known = std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
      return distance(place.in_odom, in_odom) < params_.same;
    });
    if (!is_known) places_.push_back({in_odom, view.stamp, 0});
  }
}

void NearThings::add(const SweepView& before, const SweepView& view, std::span<const float> expected,
                     const SweepForm& form) {
  note_nearest(view);
  revise(view);
  const double elapsed = std::max(0.0, to_seconds(view.stamp - before.stamp));
  if (elapsed > params_.fast) {
    sure_ = places_.empty() ? 0 : sure_ + 1;
    return;
  }
  const double farthest = nearest(view) + params_.comes + params_.step * elapsed;
  const PointTransform now_from_before{inverse(view.odom_from_sensor) * before.odom_from_sensor};
  std::vector<Point2> gone;
  for (std::size_t i = 0; i < before.ranges.size(); ++i) {
    if (!before.met(i) || before.ranges[i] > farthest) continue;
    const Point2 at = now_from_before * before.place(i);
    const long sample = view.sample_to(at);
    // A thing hides what is behind it from the beams beside as well: all three say "nothing".
    if (sample >= 0 && norm(at) < nearest(view) + params_.goes &&
        view.nearest[static_cast<std::size_t>(sample)] == kNoAnswer &&
        view.ranges[static_cast<std::size_t>(sample)] == kNoAnswer)
      gone.push_back(view.odom_from_sensor * at);
  }
  if (static_cast<int>(gone.size()) < params_.several) gone.clear();
  gaps_ = find_gaps(view, expected, gone) ? gaps_ + 1 : 0;
  hold(view, gone);
  sure_ = places_.empty() && form.too_near.empty() && heard_ < params_.heard ? 0 : sure_ + 1;
}

void NearThings::hear(const SweepView& view, std::span<const Point2> heard, bool may_be_blind) {
  std::erase_if(seen_, [&](const Seen& seen) { return view.stamp - seen.stamp > seconds(params_.seen_for); });
  std::vector<Point2> left_out;
  for (const Point2 at : heard) {
    const Point2 in_odom = view.odom_from_sensor * at;
    const bool is_stated = may_be_blind && norm(at) <= nearest(view) + params_.same;
    const bool was_seen = std::any_of(seen_.begin(), seen_.end(), [&](const Seen& seen) {
      return distance(seen.in_odom, in_odom) <= params_.seen_at;
    });
    if (is_stated || was_seen) left_out.push_back(in_odom);
  }
  heard_ = static_cast<int>(left_out.size()) >= params_.heard ? heard_ + 1 : 0;
  if (heard_ >= params_.heard) hold(view, left_out);
  for (std::size_t i = 0; i < view.ranges.size(); ++i)
    if (view.met(i) && view.ranges[i] <= params_.within)
      seen_.push_back({view.stamp, view.odom_from_sensor * view.place(i)});
}

std::vector<BeamRun> NearThings::hidden_in(const SensorSweep& sweep, const Pose2& odom_from_sensor) const {
  const PointTransform sensor_from_odom{inverse(odom_from_sensor)};
  std::vector<BeamRun> runs;
  const auto beams = static_cast<long>(sweep.ranges.size());
  const auto aside = static_cast<long>(std::ceil(params_.beside / sweep.bearing_step));
  for (const Place& place : places_) {
    const long beam = beam_to(sensor_from_odom * place.in_odom, sweep.first_bearing, sweep.bearing_step);
    for (long i = std::max(0L, beam - aside); i <= std::min(beams - 1, beam + aside); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (sweep.ranges[at] >= sweep.max_range) runs.push_back({at, at + 1});
    }
  }
  return runs;
}

}  // namespace docent::collision_avoidance
