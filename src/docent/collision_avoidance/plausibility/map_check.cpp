#include "docent/collision_avoidance/plausibility/map_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::collision_avoidance {

void MapCheck::believe(Time stamp, const Pose2& map_from_odom, double mass) {
  map_from_odom_.reset();
  if (mass >= params_.least_mass) map_from_odom_ = map_from_odom;
  believed_ = stamp;
}

float MapCheck::cast(Point2 from, Point2 ray, double reach) const {
  // Cell by cell, Amanatides and Woo.
  const GridFrame& frame = map_->frame;
  CellIndex cell = frame.cell_at(from);
  const int step_x = ray.x > 0.0 ? 1 : -1;
  const int step_y = ray.y > 0.0 ? 1 : -1;
  const double infinite = std::numeric_limits<double>::infinity();
  const auto first = [&](double at, double origin, int index, double along) {
    const double edge = origin + (index + (along > 0.0 ? 1 : 0)) * frame.resolution;
    return along != 0.0 ? (edge - at) / along : infinite;
  };
  double to_x = first(from.x, frame.origin.x, cell.column, ray.x);
  double to_y = first(from.y, frame.origin.y, cell.row, ray.y);
  const double across_x = ray.x != 0.0 ? frame.resolution / std::abs(ray.x) : infinite;
  const double across_y = ray.y != 0.0 ? frame.resolution / std::abs(ray.y) : infinite;
  double range = 0.0;
  while (range < reach) {
    const std::int8_t value = map_->at(cell);
    if (value >= 65) return static_cast<float>(range + 0.5 * frame.resolution);
    if (value == OccupancyGrid::kUnknown) return std::numeric_limits<float>::quiet_NaN();
    if (to_x < to_y) {
      range = to_x;
      to_x += across_x;
      cell.column += step_x;
    } else {
      range = to_y;
      to_y += across_y;
      cell.row += step_y;
    }
  }
  return kNoAnswer;
}

void MapCheck::expect_at(const SweepView& view, const Pose2& map_from_sensor, std::size_t every,
                         std::vector<float>& expected) const {
  expected.assign(view.ranges.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < expected.size(); i += every) {
    const Angle bearing =
        map_from_sensor.theta + Angle::radians(view.first_bearing + static_cast<double>(i) * view.bearing_step);
    expected[i] = cast(map_from_sensor.position(), unit(bearing), view.max_range);
  }
}

bool MapCheck::is_wrong_place(const SweepView& view, const Pose2& map_from_sensor, const RangeLaw& law) const {
  const double needed = static_cast<double>(law.as_law) / law.compared - params_.as_well;
  std::vector<float> expected;
  for (const double turn :
       {-params_.off_turn, -0.5 * params_.off_turn, 0.0, 0.5 * params_.off_turn, params_.off_turn}) {
    for (double x = -params_.off; x <= params_.off; x += params_.off_step) {
      for (double y = -params_.off; y <= params_.off; y += params_.off_step) {
        expect_at(view, map_from_sensor * Pose2{x, y, Angle::radians(turn)}, 3 * params_.every, expected);
        const RangeLaw there = find_law(expected, view, params_.law);
        if (there.compared > 0 && there.is_as_expected(needed)) return true;
      }
    }
  }
  return false;
}

std::optional<MapCheck::Finding> MapCheck::compare(const SweepView& view) {
  if (!map_ || !map_from_odom_ || view.stamp - believed_ > seconds(params_.longest)) return Finding{};
  if (view.stamp - compared_ < seconds(params_.between)) return std::nullopt;
  compared_ = view.stamp;
  const Pose2 map_from_sensor = *map_from_odom_ * view.odom_from_sensor;
  expect_at(view, map_from_sensor, params_.every, expected_);
  const RangeLaw law = find_law(expected_, view, params_.law);
  Finding finding;
  const auto samples =
      std::count_if(expected_.begin(), expected_.end(), [](float range) { return !std::isnan(range); });
  finding.is_known = samples >= params_.law.least;
  finding.is_nothing_near = finding.is_known && law.compared <= params_.nothing_near * static_cast<double>(samples);
  finding.in_order = law.compared >= params_.law.least && law.is_as_expected(params_.fits);
  int answers = 0;
  for (std::size_t i = 0; i < expected_.size(); ++i) answers += view.met(i) && expected_[i] < view.max_range ? 1 : 0;
  finding.fits = answers >= params_.least_answers && law.as_expected >= params_.fits * answers;
  const bool is_off = is_lie(law, params_.law) && !is_wrong_place(view, map_from_sensor, law);
  row_ = is_off ? row_ + 1 : 0;
  if (row_ >= params_.sure) finding.lie = law;
  return finding;
}

}  // namespace docent::collision_avoidance
