#include "docent/mapping/mount_calibration/scan_follower.h"

#include <algorithm>
#include <cmath>

namespace docent::mapping {
namespace {

constexpr std::size_t kMostWaiting = 64;  // some seconds of the fastest scanner
constexpr std::size_t kFewestPoints = 30;

}  // namespace

void ScanFollower::keep(Time stamp, const sensor_models::LaserReading& reading) {
  Waiting sweep{stamp, reading, {reading.ranges.begin(), reading.ranges.end()}};
  sweep.reading.ranges = {};
  waiting_.push_back(std::move(sweep));
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
}

void ScanFollower::forget() {
  waiting_.clear();
  reference_.reset();
}

std::vector<SurfacePoint> ScanFollower::points_of(Waiting& sweep) const {
  sweep.reading.ranges = sweep.ranges;
  sensor_models::RangeSweep beams;
  append(beams, sweep.reading, Pose2{});
  std::vector<SurfacePoint> points = surface_points(beams, params_.points);
  const auto most = static_cast<std::size_t>(params_.most_points);
  if (points.size() <= most) return points;
  std::vector<SurfacePoint> thinned;
  for (std::size_t i = 0; i < most; ++i) thinned.push_back(points[i * points.size() / most]);
  return thinned;
}

bool ScanFollower::is_worth_it(const Pose2& moved) const {
  return norm(moved.position()) >= params_.step || std::abs(moved.theta.degrees()) >= params_.step_turn;
}

void ScanFollower::begin(Time stamp, const std::vector<SurfacePoint>& points) {
  reference_.reset();
  last_ = stamp;
  reference_from_last_ = {};
  if (points.size() >= kFewestPoints) reference_.emplace(Reference{stamp, SurfaceIndex{points}});
}

std::optional<MotionPair> ScanFollower::look(const motion_models::OdometryHistory& odometry, const Pose2& mount,
                                             double way) {
  Waiting sweep = std::move(waiting_.front());
  waiting_.pop_front();
  if (!reference_ || to_seconds(sweep.stamp - reference_->stamp) > params_.longest) {
    begin(sweep.stamp, points_of(sweep));
    return std::nullopt;
  }
  const auto then = odometry.at(last_, Duration{});
  const auto now = odometry.at(sweep.stamp, Duration{});
  if (!then || !now) {
    reference_.reset();
    return std::nullopt;
  }
  const Pose2 moved = inverse(*then) * *now;
  if (!is_worth_it(moved)) return std::nullopt;
  const auto points = points_of(sweep);
  std::optional<LineMatch> match;
  if (points.size() >= kFewestPoints)
    match =
        line_match(reference_->surfaces, points, reference_from_last_ * inverse(mount) * moved * mount, params_.lines);
  if (!match || match->overlap < params_.least_overlap || match->residual > params_.most_residual) {
    begin(sweep.stamp, points);
    return std::nullopt;
  }
  reference_from_last_ = match->reference_from_sweep;
  last_ = sweep.stamp;
  const bool is_far =
      norm(reference_from_last_.position()) >= way || std::abs(reference_from_last_.theta.degrees()) >= params_.turn;
  if (!is_far) return std::nullopt;
  std::optional<MotionPair> pair;
  if (auto base = ShiftedMotion::between(odometry, reference_->stamp, sweep.stamp)) {
    const double disagreement = (base->at(0.0).theta - reference_from_last_.theta).degrees();
    if (std::abs(disagreement) <= params_.most_disagreement)
      pair = MotionPair{reference_from_last_, match->information, *base};
  }
  begin(sweep.stamp, points);
  return pair;
}

std::vector<MotionPair> ScanFollower::follow(const motion_models::OdometryHistory& odometry, const Pose2& mount,
                                             double way) {
  std::vector<MotionPair> pairs;
  while (!waiting_.empty() && !odometry.empty() &&
         waiting_.front().stamp + seconds(ShiftedMotion::kMost) <= odometry.latest_time()) {
    if (auto pair = look(odometry, mount, way)) pairs.push_back(std::move(*pair));
  }
  return pairs;
}

}  // namespace docent::mapping
