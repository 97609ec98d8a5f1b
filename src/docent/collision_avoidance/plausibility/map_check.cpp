#include "docent/collision_avoidance/plausibility/map_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace docent::collision_avoidance {

namespace {

OccupancyGrid passable(OccupancyGrid map) {
  for (std::int8_t& cell : map.cells)
    if (cell != OccupancyGrid::kUnknown && cell < 65) cell = OccupancyGrid::kFree;
  return map;
}

}  // namespace

std::shared_ptr<const sensor_models::RayCaster> known_walls(const std::shared_ptr<const OccupancyGrid>& map) {
  return map ? std::make_shared<const sensor_models::RayCaster>(passable(*map)) : nullptr;
}

MapCheck::MapCheck(std::shared_ptr<const sensor_models::RayCaster> walls, const MapCheckParams& params)
    : params_{params}, walls_{std::move(walls)} {
  if (walls_) half_cell_ = 0.5 * walls_->frame().resolution;
}

void MapCheck::believe(Time stamp, const Pose2& map_from_odom, double mass) {
  map_from_odom_.reset();
  if (mass >= params_.least_mass) map_from_odom_ = map_from_odom;
  believed_ = stamp;
}

std::vector<Point2> MapCheck::rays_of(const SweepView& view, Angle heading, std::size_t every) const {
  std::vector<Point2> rays(view.ranges.size());
  for (std::size_t i = 0; i < rays.size(); i += every)
    rays[i] = unit(heading + Angle::radians(view.first_bearing + static_cast<double>(i) * view.bearing_step));
  return rays;
}

void MapCheck::expect_at(const SweepView& view, Point2 in_map, std::span<const Point2> rays, std::size_t every,
                         std::vector<float>& expected) const {
  expected.assign(view.ranges.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < expected.size(); i += every) {
    const auto range = walls_->cast(in_map, rays[i], view.max_range, 0.0);
    if (range) expected[i] = *range < view.max_range ? static_cast<float>(*range + half_cell_) : kNoAnswer;
  }
}

bool MapCheck::is_wrong_place(const SweepView& view, const Pose2& map_from_sensor, const RangeLaw& law) const {
  const std::size_t every = 3 * params_.every;
  const double needed = static_cast<double>(law.as_law) / law.compared - params_.as_well;
  std::vector<float> expected;
  for (const double turn :
       {-params_.off_turn, -0.5 * params_.off_turn, 0.0, 0.5 * params_.off_turn, params_.off_turn}) {
    const std::vector<Point2> rays = rays_of(view, map_from_sensor.theta + Angle::radians(turn), every);
    for (double x = -params_.off; x <= params_.off; x += params_.off_step) {
      for (double y = -params_.off; y <= params_.off; y += params_.off_step) {
        expect_at(view, map_from_sensor * Point2{x, y}, rays, every, expected);
        const RangeLaw there = find_law(expected, view, params_.law);
        if (there.compared > 0 && there.is_as_expected(needed)) return true;
      }
    }
  }
  return false;
}

bool MapCheck::is_expected_from(const SweepView& view, const Pose2& map_from_sensor) const {
  const Pose2 moved = inverse(expected_of_.map_from_sensor) * map_from_sensor;
  return expected_.size() == view.ranges.size() && expected_of_.first_bearing == view.first_bearing &&
         expected_of_.bearing_step == view.bearing_step && expected_of_.max_range == view.max_range &&
         norm(moved.position()) <= params_.stands && std::abs(moved.theta.radians()) <= params_.stands_turn;
}

std::optional<MapCheck::Finding> MapCheck::compare(const SweepView& view) {
  if (!walls_ || !map_from_odom_ || view.stamp - believed_ > seconds(params_.longest)) return Finding{};
  if (view.stamp - compared_ < seconds(params_.between)) return std::nullopt;
  compared_ = view.stamp;
  const Pose2 map_from_sensor = *map_from_odom_ * view.odom_from_sensor;
  if (!is_expected_from(view, map_from_sensor)) {
    expected_of_ = {map_from_sensor, view.first_bearing, view.bearing_step, view.max_range};
    const std::vector<Point2> rays = rays_of(view, map_from_sensor.theta, params_.every);
    expect_at(view, map_from_sensor.position(), rays, params_.every, expected_);
  }
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
