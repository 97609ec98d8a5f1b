#include "docent/localization/learning/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "docent/localization/learning/readings.h"

namespace docent::localization {

namespace {

/// How badly a sweep fits the map at a pose near `label`; less is better.
class Misfit {
 public:
  Misfit(const RecordedSweep& recorded, const Pose2& map_from_base, const sensor_models::RayCaster& caster,
         double max_range, const RefinementParams& params)
      : caster_{caster}, max_range_{max_range}, params_{params}, label_{map_from_base * recorded.base_from_sensor} {
    const auto& all = recorded.sweep.beams;
    const std::size_t step = std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(params.beams));
    for (std::size_t i = 0; i < all.size(); i += step)
      if (!all[i].no_return && all[i].range < max_range) beams_.push_back(all[i]);
  }

  [[nodiscard]] const Pose2& label() const { return label_; }

  [[nodiscard]] double at(const Pose2& map_from_sensor) const {
    double sum = 0.0;
    for (const sensor_models::SweepBeam& beam : beams_) {
      const Angle direction = map_from_sensor.theta + Angle::radians(beam.bearing);
      const auto range = caster_.cast(map_from_sensor.position(), unit(direction), max_range_, kUnknownAllowance);
      if (!range) continue;
      const double expected = *range + 0.5 * caster_.frame().resolution;
      const double off = (beam.range - expected) / (params_.scale + params_.scale_per_metre * expected);
      sum += params_.independent * std::log1p(off * off);
    }
    const double shift = distance(map_from_sensor.position(), label_.position()) / params_.most_shift;
    const double turn = (map_from_sensor.theta - label_.theta).degrees() / params_.most_turn;
    return sum + 0.5 * (shift * shift + turn * turn);
  }

 private:
  const sensor_models::RayCaster& caster_;
  double max_range_;
  RefinementParams params_;
  Pose2 label_;
  std::vector<sensor_models::SweepBeam> beams_;
};

/// Pattern search: steps along each axis as long as they help, then shorter ones.
Pose2 best_near(const Misfit& misfit) {
  constexpr int kMostSteps = 8;  // of one length
  Pose2 best = misfit.label();
  double value = misfit.at(best);
  for (double length : {1.0, 0.5, 0.25, 0.125}) {
    const double shift = 0.08 * length;
    const double turn = std::numbers::pi / 180.0 * length;
    const std::array<Pose2, 6> steps{Pose2{shift, 0.0, {}},
                                     {-shift, 0.0, {}},
                                     {0.0, shift, {}},
                                     {0.0, -shift, {}},
                                     {0.0, 0.0, Angle::radians(turn)},
                                     {0.0, 0.0, Angle::radians(-turn)}};
    for (int n = 0; n < kMostSteps; ++n) {
      bool moved = false;
      for (const Pose2& step : steps) {
        const Pose2 next = best * step;
        const double there = misfit.at(next);
        if (there >= value) continue;
        best = next;
        value = there;
        moved = true;
      }
      if (!moved) break;
    }
  }
  return best;
}

}  // namespace

void refine(std::span<const RecordedSweep> sweeps, const sensor_models::RayCaster& caster, double max_range,
            const RefinementParams& params, std::vector<PoseLabel>& labels) {
  struct Refined {
    Pose2 odom_from_base;
    Pose2 map_from_base;
  };
  std::map<int, Refined> last;  // by sensor
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (!labels[i].sure) {
      last.clear();
      continue;
    }
    const RecordedSweep& recorded = sweeps[i];
    if (const auto before = last.find(recorded.sensor); before != last.end()) {
      const Pose2 moved = inverse(before->second.odom_from_base) * recorded.odom_from_base;
      if (norm(moved.position()) < params.stride && std::abs(moved.theta.degrees()) < params.stride_turn) {
        labels[i].map_from_base = before->second.map_from_base * moved;
        continue;
      }
    }
    const Misfit misfit{recorded, labels[i].map_from_base, caster, max_range, params};
    labels[i].map_from_base = best_near(misfit) * inverse(recorded.base_from_sensor);
    last[recorded.sensor] = {recorded.odom_from_base, labels[i].map_from_base};
  }
}

}  // namespace docent::localization
