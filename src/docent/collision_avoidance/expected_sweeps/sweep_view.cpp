#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"
#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"
#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {
namespace {

/// As SweepView has it.
float sample_of(double range, double min_range, double max_range) {
  if (std::isnan(range) || range < min_range) return std::numeric_limits<float>::quiet_NaN();
  return range >= max_range ? kNoAnswer : static_cast<float>(range);
}

std::shared_ptr<const SampleRays> rays_of(const SweepView& view, const std::shared_ptr<const SampleRays>& like) {
  const std::size_t samples = view.ranges.size();
  if (like && like->first_bearing == view.first_bearing && like->bearing_step == view.bearing_step &&
      like->units.size() == samples)
    return like;
  SampleRays rays{view.first_bearing, view.bearing_step,
                  beam_directions(view.first_bearing, view.bearing_step, samples)};
  return std::make_shared<const SampleRays>(std::move(rays));
}

}  // namespace

long SweepView::sample_to(Point2 in_sensor) const {
  const long sample = beam_to(in_sensor, first_bearing, bearing_step);
  return sample < static_cast<long>(ranges.size()) ? sample : -1;
}

SweepView view_of(const SensorSweep& sweep, const Pose2& odom_from_sensor, std::size_t most,
                  const std::shared_ptr<const SampleRays>& like) {
  const std::size_t beams = sweep.ranges.size();
  const std::size_t stride = std::max<std::size_t>(1, (beams + most - 1) / most);
  SweepView view;
  view.stamp = sweep.stamp;
  view.odom_from_sensor = odom_from_sensor;
  view.first_bearing = sweep.first_bearing + 0.5 * static_cast<double>(stride - 1) * sweep.bearing_step;
  view.bearing_step = static_cast<double>(stride) * sweep.bearing_step;
  view.min_range = sweep.min_range;
  view.max_range = sweep.max_range;
  const std::size_t samples = beams / stride;
  view.ranges.reserve(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const double middle = sweep.ranges[i * stride + (stride - 1) / 2];
    view.ranges.push_back(sample_of(middle, sweep.min_range, sweep.max_range));
    if (view.met(i)) ++view.answers;
  }
  view.rays = rays_of(view, like);
  view.nearest.resize(samples);
  view.farthest.resize(samples);
  for (std::size_t i = 0; i < samples; ++i) {
    float nearest = kNoAnswer;
    float farthest = 0.0F;
    for (std::size_t k = i > 0 ? i - 1 : i; k < std::min(i + 2, samples); ++k) {
      if (std::isnan(view.ranges[k])) continue;
      nearest = std::min(nearest, view.ranges[k]);
      farthest = std::max(farthest, view.ranges[k]);
    }
    view.nearest[i] = nearest;
    view.farthest[i] = farthest;
  }
  return view;
}

SweepView walls_of(const SweepView& view) {
  std::vector<Point2> places;
  std::vector<double> ranges;
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < view.ranges.size(); ++i) {
    if (!view.met(i)) continue;
    places.push_back(view.place(i));
    ranges.push_back(static_cast<double>(view.ranges[i]));
    samples.push_back(i);
  }
  const std::vector<bool> straight = on_straight_pieces(places, ranges, view.bearing_step);
  SweepView walls = view;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (!straight[k]) walls.ranges[samples[k]] = std::numeric_limits<float>::quiet_NaN();
  return walls;
}

void expect(const SweepView& seen, const Pose2& like_from_seen, const SweepView& like, std::vector<float>& expected) {
  expected.assign(like.ranges.size(), std::numeric_limits<float>::quiet_NaN());
  const PointTransform to_like{like_from_seen};
  for (std::size_t i = 0; i < seen.ranges.size(); ++i) {
    if (!seen.met(i)) continue;
    const Point2 at = to_like * seen.place(i);
    const long sample = like.sample_to(at);
    if (sample < 0) continue;
    float& range = expected[static_cast<std::size_t>(sample)];
    const auto found = static_cast<float>(norm(at));
    if (!(range <= found)) range = found;
  }
}

}  // namespace docent::collision_avoidance
