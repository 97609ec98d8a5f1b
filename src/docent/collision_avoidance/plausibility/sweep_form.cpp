#include "docent/collision_avoidance/plausibility/sweep_form.h"

#include <algorithm>
#include <cmath>

#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {
namespace {

/// Counts readings, and how many different ones there are, as far as that matters.
class ReadingCount {
 public:
  void add(float range) {
    ++count_;
    if (values_.size() < 16 && std::find(values_.begin(), values_.end(), range) == values_.end())
      values_.push_back(range);
  }
  [[nodiscard]] bool are_many(double share, std::size_t beams, int several) const {
    return static_cast<double>(count_) >= share * static_cast<double>(beams) &&
           static_cast<int>(values_.size()) >= several;
  }

 private:
  std::size_t count_ = 0;
  std::vector<float> values_;
};

bool has_wrong_units(const SensorSweep& sweep, const SweepFormParams& params) {
  ReadingCount beyond;
  ReadingCount tiny;
  std::size_t within = 0;
  for (const float range : sweep.ranges) {
    if (!std::isfinite(range)) continue;
    if (range > params.beyond * sweep.max_range) beyond.add(range);
    if (range >= sweep.min_range && range < sweep.max_range) ++within;
    if (range > 0.0F && range < params.tiny) tiny.add(range);
  }
  const bool is_any_within = static_cast<double>(within) > params.few_within * static_cast<double>(sweep.ranges.size());
  return (!is_any_within && beyond.are_many(params.many_beyond, sweep.ranges.size(), params.several)) ||
         tiny.are_many(params.many_tiny, sweep.ranges.size(), params.several);
}

bool is_covered(const SensorSweep& sweep, const BaseLimits& limits, const SweepFormParams& params) {
  const double within = limits.inradius() - params.inside;
  const double farthest = within + norm(sweep.base_from_sensor.position());
  const PointTransform base_from_sensor{sweep.base_from_sensor};
  double run = 0.0;
  for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
    const double range = sweep.ranges[i];
    bool is_inside = range >= sweep.min_range && range < farthest;
    if (is_inside) {
      const Angle bearing = Angle::radians(sweep.first_bearing + static_cast<double>(i) * sweep.bearing_step);
      is_inside = norm(base_from_sensor * (range * unit(bearing))) < within;
    }
    run = is_inside ? run + sweep.bearing_step : 0.0;
    if (run >= params.covered) return true;
  }
  return false;
}

bool is_no_answer(float range, const SensorSweep& sweep) { return range >= sweep.max_range; }

std::vector<BeamRun> too_near(const SensorSweep& sweep, double nearest, const SweepFormParams& params) {
  const double near = (1.0 + params.near_share) * nearest + params.near;
  const auto is_flank = [&](std::size_t beam) { return sweep.ranges[beam] >= 0.0F && sweep.ranges[beam] <= near; };
  std::vector<BeamRun> runs;
  const std::size_t beams = sweep.ranges.size();
  for (std::size_t i = 0; i < beams;) {
    if (!is_no_answer(sweep.ranges[i], sweep)) {
      ++i;
      continue;
    }
    const std::size_t first = i;
    while (i < beams && is_no_answer(sweep.ranges[i], sweep)) ++i;
    const bool is_wide = static_cast<double>(i - first) * sweep.bearing_step >= params.least_gap;
    if (is_wide && first > 0 && i < beams && is_flank(first - 1) && is_flank(i)) runs.push_back({first, i});
  }
  return runs;
}

}  // namespace

bool can_be_too_near(const SensorSweep& sweep, double nearest, const BaseLimits& limits) {
  return norm(sweep.base_from_sensor.position()) + nearest > limits.inradius();
}

SweepForm form_of(const SensorSweep& sweep, double nearest, const BaseLimits& limits, const SweepFormParams& params) {
  SweepForm form;
  if (sweep.ranges.empty()) return form;
  form.has_wrong_units = has_wrong_units(sweep, params);
  if (form.has_wrong_units) return form;
  form.is_covered = is_covered(sweep, limits, params);
  const auto beams = static_cast<double>(sweep.ranges.size());
  const auto silent =
      std::count_if(sweep.ranges.begin(), sweep.ranges.end(), [&](float range) { return is_no_answer(range, sweep); });
  const auto answers = std::count_if(sweep.ranges.begin(), sweep.ranges.end(),
                                     [&](float range) { return range >= sweep.min_range && range < sweep.max_range; });
  form.is_silent = static_cast<double>(silent) >= params.silent_share * beams &&
                   static_cast<double>(answers) <= std::max(1.0, params.few_answers * beams);
  if (can_be_too_near(sweep, nearest, limits)) form.too_near = too_near(sweep, nearest, params);
  return form;
}

}  // namespace docent::collision_avoidance
