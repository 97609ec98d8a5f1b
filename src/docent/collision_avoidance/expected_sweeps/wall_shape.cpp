#include "docent/collision_avoidance/expected_sweeps/wall_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::collision_avoidance {
namespace {

constexpr std::array<double, 13> kOffsets{-1.0, -0.7, -0.5, -0.4, -0.3, -0.2, 0.2,
                                          0.3,  0.4,  0.5,  0.6,  0.8,  1.0};  // [m]
constexpr double kNearest = 0.1;                                               // [m] an offset cannot leave less

/// Through points by least squares of the distances from it.
struct Line {
  Point2 at;
  Point2 normal;
  [[nodiscard]] double distance_of(Point2 point) const {
    return std::abs((point.x - at.x) * normal.x + (point.y - at.y) * normal.y);
  }
};

Line line_through(std::span<const Point2> points) {
  Point2 mean;
  for (const Point2 point : points) mean = mean + point;
  mean = (1.0 / static_cast<double>(points.size())) * mean;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Point2 point : points) {
    const Point2 off = point - mean;
    xx += off.x * off.x;
    xy += off.x * off.y;
    yy += off.y * off.y;
  }
  const double along = 0.5 * std::atan2(2.0 * xy, xx - yy);
  return {mean, {-std::sin(along), std::cos(along)}};
}

}  // namespace

std::optional<double> WallShape::error_of(std::span<const float> ranges, double first_bearing, double bearing_step,
                                          double offset) const {
  std::vector<Point2> points;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double range = static_cast<double>(ranges[i]) - offset;
    if (!(ranges[i] < kNoAnswer) || range < kNearest) continue;
    points.push_back(range * unit(Angle::radians(first_bearing + static_cast<double>(i) * bearing_step)));
  }
  const double enough = params_.on_wall * static_cast<double>(ranges.size());
  if (static_cast<double>(points.size()) < enough) return std::nullopt;
  // A few who stand before the wall are left out, the worst first.
  std::vector<Point2> kept = points;
  Line line = line_through(kept);
  for (int round = 0; round < 4; ++round) {
    const double widest = std::max(params_.outlier * params_.noise, 0.3 / (1 << round));
    std::vector<Point2> near;
    for (const Point2 point : points)
      if (line.distance_of(point) <= widest) near.push_back(point);
    if (static_cast<double>(near.size()) < enough) return std::nullopt;
    kept = std::move(near);
    line = line_through(kept);
  }
  double error = 0.0;
  for (const Point2 point : points) {
    const double off = std::min(line.distance_of(point) / params_.noise, params_.outlier);
    error += off * off;
  }
  return error / static_cast<double>(points.size());
}

void WallShape::judge_window(const SweepView& view, std::size_t first, std::size_t count, Look& found) const {
  const auto ranges = std::span{view.ranges}.subspan(first, count);
  const double bearing = view.first_bearing + static_cast<double>(first) * view.bearing_step;
  const double none = params_.outlier * params_.outlier;
  const double as_is = error_of(ranges, bearing, view.bearing_step, 0.0).value_or(none);
  double best = none;
  double offset = 0.0;
  for (const double other : kOffsets) {
    const double error = error_of(ranges, bearing, view.bearing_step, other).value_or(none);
    if (error < best) {
      best = error;
      offset = other;
    }
  }
  if (as_is >= none && best >= none) return;
  if (best + params_.better <= as_is) found.bent.push_back(offset);
  if (as_is + params_.better <= best) ++found.straight;
}

WallShape::Look WallShape::look(const SweepView& view) const {
  Look found{view.stamp, {}, 0};
  const auto count = static_cast<std::size_t>(params_.window / view.bearing_step);
  const auto step = std::max<std::size_t>(1, static_cast<std::size_t>(params_.step / view.bearing_step));
  for (std::size_t first = 0; first + count <= view.ranges.size(); first += step)
    judge_window(view, first, count, found);
  return found;
}

WallShape::Finding WallShape::add(const SweepView& view) {
  if (!looks_.empty() && view.stamp - looks_.back().stamp < seconds(params_.between)) return Finding::nothing;
  std::erase_if(looks_, [&](const Look& old) { return view.stamp - old.stamp > seconds(params_.memory); });
  looks_.push_back(look(view));
  const Look& now = looks_.back();
  if (now.bent.empty()) return now.straight > 0 ? Finding::straight : Finding::nothing;
  std::vector<double> offsets = now.bent;
  const auto middle = offsets.begin() + static_cast<std::ptrdiff_t>(offsets.size() / 2);
  std::nth_element(offsets.begin(), middle, offsets.end());
  const double offset = *middle;
  int windows = 0;
  int contrary = 0;
  int looks = 0;
  for (const Look& old : looks_) {
    const auto same = static_cast<int>(std::count_if(
        old.bent.begin(), old.bent.end(), [&](double other) { return std::abs(other - offset) <= params_.same; }));
    windows += same;
    contrary += old.straight + static_cast<int>(old.bent.size()) - same;
    looks += same > 0 ? 1 : 0;
  }
  const bool is_bent = looks >= params_.looks && windows >= params_.windows && windows >= params_.one_sided * contrary;
  if (!is_bent) return Finding::nothing;
  offset_ = offset;
  return Finding::bent;
}

}  // namespace docent::collision_avoidance
