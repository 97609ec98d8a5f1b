#include "docent/localization/learning/labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace docent::localization {

namespace {

/// What one run says of one sweep.
struct Opinion {
  Pose2 map_from_base;
  bool knows = false;
  double p_lost = 1.0;
};
struct Run {
  std::vector<Opinion> opinions;
  std::size_t first_known = 0;  ///< sweeps, in the order of the run, before it first knew its place
  double fit = -std::numeric_limits<double>::infinity();
};

/// The frame whose pose the localizer tracks. With one sensor its own: seen from the robot's centre, a beam along a
/// wall would pass through the door post. With several, the robot's.
bool is_one_sensor(std::span<const RecordedSweep> sweeps) {
  return std::all_of(sweeps.begin(), sweeps.end(), [&](const auto& s) { return s.sensor == sweeps.front().sensor; });
}

/// The sweep in the robot's frame, together with what the other sensors saw at about the same moment.
class Surroundings {
 public:
  sensor_models::RangeSweep add(const RecordedSweep& recorded) {
    constexpr double kTogether = 0.25;  // [s], as a robot's module has it
    sensor_models::RangeSweep all;
    last_[recorded.sensor] = &recorded;
    for (const auto& [sensor, other] : last_) {
      if (std::abs(to_seconds(recorded.time - other->time)) > kTogether) continue;
      const Pose2 now_from_then = inverse(recorded.odom_from_base) * other->odom_from_base;
      const sensor_models::RangeSweep seen =
          sensor_models::seen_from(other->sweep, now_from_then * other->base_from_sensor);
      all.beams.insert(all.beams.end(), seen.beams.begin(), seen.beams.end());
    }
    return all;
  }

 private:
  std::map<int, const RecordedSweep*> last_;
};

Run run(std::span<const RecordedSweep> sweeps, MarkovLocalizer& localizer, bool reverse,
        const std::function<void()>& tick) {
  Run result;
  result.opinions.resize(sweeps.size());
  result.first_known = sweeps.size();
  if (sweeps.empty()) return result;
  const bool own_frame = is_one_sensor(sweeps);
  localizer.start_unknown();
  Surroundings around;
  double fit = 0.0;
  std::size_t fitted = 0;
  const Duration end{sweeps.back().time.nanoseconds};
  for (std::size_t n = 0; n < sweeps.size(); ++n) {
    const std::size_t i = reverse ? sweeps.size() - 1 - n : n;
    const RecordedSweep& recorded = sweeps[i];
    const Time time = reverse ? Time{end.count() - recorded.time.nanoseconds} : recorded.time;
    const Pose2 base_from_tracked = own_frame ? recorded.base_from_sensor : Pose2{};
    const Pose2 odom_from_tracked = recorded.odom_from_base * base_from_tracked;
    const auto step = localizer.observe(own_frame ? recorded.sweep : around.add(recorded), odom_from_tracked, time);
    if (step.updated && step.fit) {
      fit += *step.fit;
      ++fitted;
    }
    Opinion& opinion = result.opinions[i];
    opinion.p_lost = localizer.verdict().p_lost();
    if (const auto best = localizer.map_from_robot(odom_from_tracked)) {
      opinion.map_from_base = *best * inverse(base_from_tracked);
      opinion.knows = localizer.verdict().localized();
    }
    if (opinion.knows) result.first_known = std::min(result.first_known, n);
    if (tick) tick();
  }
  if (fitted > 0) result.fit = fit / static_cast<double>(fitted);
  return result;
}

PoseLabel middle(const Opinion& a, const Opinion& b, const LabelParams& params) {
  const Angle turned = b.map_from_base.theta - a.map_from_base.theta;
  const Pose2 mean{0.5 * (a.map_from_base.x + b.map_from_base.x), 0.5 * (a.map_from_base.y + b.map_from_base.y),
                   Angle::radians(a.map_from_base.theta.radians() + 0.5 * turned.radians())};
  const bool agree = distance(a.map_from_base.position(), b.map_from_base.position()) <= params.most_apart &&
                     std::abs(turned.degrees()) <= params.most_turned;
  return {mean, agree};
}

}  // namespace

Labelling label(std::span<const RecordedSweep> sweeps, MarkovLocalizer& localizer, const LabelParams& params,
                const std::function<void(std::size_t, std::size_t)>& progress) {
  std::size_t done = 0;
  const auto tick = [&] {
    if (++done % 500 == 0 && progress) progress(done, 2 * sweeps.size());
  };
  const Run forward = run(sweeps, localizer, false, tick);
  const Run reversed = run(sweeps, localizer, true, tick);
  Labelling result;
  result.labels.resize(sweeps.size());
  result.fit = 0.5 * (forward.fit + reversed.fit);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const Opinion& a = forward.opinions[i];
    const Opinion& b = reversed.opinions[i];
    PoseLabel& chosen = result.labels[i];
    if (a.knows && b.knows) {
      chosen = middle(a, b, params);
      const bool far = distance(a.map_from_base.position(), b.map_from_base.position()) > params.other_place ||
                       std::abs((a.map_from_base.theta - b.map_from_base.theta).degrees()) > params.other_heading;
      result.contradicted += far ? 1 : 0;
    } else if (a.knows && sweeps.size() - 1 - i < reversed.first_known) {
      chosen = {a.map_from_base, a.p_lost <= params.most_p_lost};
    } else if (b.knows && i < forward.first_known) {
      chosen = {b.map_from_base, b.p_lost <= params.most_p_lost};
    }
    result.sure += chosen.sure ? 1 : 0;
  }
  return result;
}

}  // namespace docent::localization
