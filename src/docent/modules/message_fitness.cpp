#include "docent/modules/message_fitness.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace docent {

namespace {

bool are_finite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

template <class Number>
bool are_finite(const std::vector<Number>& values) {
  return std::all_of(values.begin(), values.end(), [](Number value) { return std::isfinite(value); });
}

}  // namespace

bool is_fit(const nav_msgs::Odometry& odometry) {
  const auto& pose = odometry.pose.pose;
  return are_finite({pose.position.x, pose.position.y, pose.orientation.x, pose.orientation.y, pose.orientation.z,
                     pose.orientation.w, odometry.twist.twist.linear.x, odometry.twist.twist.angular.z});
}

bool is_fit(const sensor_msgs::LaserScan& scan) {
  return are_finite({scan.angle_min, scan.angle_increment, scan.range_min}) && scan.angle_increment > 0.0F &&
         scan.range_max > scan.range_min;
}

bool is_fit_all_round(const sensor_msgs::LaserScan& scan) {
  constexpr double kNearlyRound = 0.99 * 2.0 * std::numbers::pi;
  const double field = static_cast<double>(scan.angle_increment) * static_cast<double>(scan.ranges.size());
  return is_fit(scan) && field >= kNearlyRound &&
         std::none_of(scan.ranges.begin(), scan.ranges.end(), [](float range) { return std::isnan(range); });
}

bool is_fit(const sensor_msgs::Range& range) {
  return std::isfinite(range.field_of_view) && range.field_of_view >= 0.0F && range.max_range > 0.0F;
}

bool is_fit(const docent_msgs::ObstacleLines& seen) {
  return std::isfinite(seen.lifetime_s) && std::all_of(seen.lines.begin(), seen.lines.end(), [](const auto& line) {
           return are_finite({line.x1, line.y1, line.x2, line.y2});
         });
}

bool is_fit(const docent_msgs::PersonBeams& beams) { return are_finite(beams.x) && are_finite(beams.y); }

bool is_fit(const docent_msgs::Belief& belief) {
  const auto is_fit_cell = [](const auto& cell) { return are_finite({cell.x, cell.y, cell.theta, cell.mass}); };
  const auto& rest = belief.rest;
  return std::isfinite(belief.p_lost) && std::all_of(belief.cells.begin(), belief.cells.end(), is_fit_cell) &&
         std::all_of(belief.hypotheses.begin(), belief.hypotheses.end(), is_fit_cell) &&
         are_finite({rest.origin_x, rest.origin_y, rest.cell_size}) && are_finite(rest.mass);
}

bool is_fit(const docent_msgs::Target& target) {
  return are_finite(target.via_x) && are_finite(target.via_y) &&
         are_finite({target.heading, target.position_tolerance, target.heading_tolerance});
}

bool is_fit(const docent_msgs::Limits& limits) { return std::isfinite(limits.max_speed) && limits.max_speed >= 0.0; }

}  // namespace docent
