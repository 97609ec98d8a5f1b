#include "docent/mapping/mount_calibration/scan_follower.h"

#include <algorithm>
#include <cmath>

#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"

namespace docent::mapping {
namespace {

constexpr std::size_t kMostWaiting = 64;  // some seconds of the fastest scanner
constexpr std::size_t kFewestPoints = 30;
constexpr std::size_t kEnoughOfWalls = 45;

bool is_far(const Pose2& moved, double way, double turn) {
  return norm(moved.position()) >= way || std::abs(moved.theta.degrees()) >= turn;
}

/// Those on straight pieces that are wider than a person, where there are enough of them to lay a sweep onto another:
/// visitors follow a guide as fast as it drives, and by them it seems to stand.
std::vector<SurfacePoint> without_people(std::vector<SurfacePoint> points, double bearing_step) {
  std::vector<Point2> places;
  std::vector<double> ranges;
  for (const SurfacePoint& point : points) {
    places.push_back(point.at);
    ranges.push_back(norm(point.at));
  }
  const std::vector<bool> straight = collision_avoidance::on_straight_pieces(places, ranges, std::abs(bearing_step));
  std::vector<SurfacePoint> walls;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (straight[i]) walls.push_back(points[i]);
  return walls.size() < kEnoughOfWalls ? points : walls;
}

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
  const std::vector<SurfacePoint> points =
      without_people(surface_points(beams, params_.points), sweep.reading.bearing_step);
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
  if (points.size() >= kFewestPoints) reference_.emplace(Reference{stamp, points});
}

std::optional<MotionPair> ScanFollower::pair_of_last(const motion_models::OdometryHistory& odometry, double way,
                                                     double turn) const {
  if (!reference_ || !is_far(reference_from_last_, way, turn)) return std::nullopt;
  const auto base = ShiftedMotion::between(odometry, reference_->stamp, last_);
  if (!base) return std::nullopt;
  const double disagreement = (base->at(0.0).theta - reference_from_last_.theta).degrees();
  if (std::abs(disagreement) > params_.most_disagreement) return std::nullopt;
  return MotionPair{reference_from_last_, information_, *base};
}

std::optional<MotionPair> ScanFollower::look(const motion_models::OdometryHistory& odometry, const Pose2& mount,
                                             double way) {
  Waiting sweep = std::move(waiting_.front());
  waiting_.pop_front();
  // Where people walk about soon nothing lies on the first sweep any more: what did until then is a witness, too.
  const auto end_early = [&](const std::vector<SurfacePoint>& points) {
    auto pair = pair_of_last(odometry, params_.least_way, params_.least_turn);
    begin(sweep.stamp, points);
    return pair;
  };
  if (!reference_ || to_seconds(sweep.stamp - reference_->stamp) > params_.longest) return end_early(points_of(sweep));
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
  if (points.size() >= kFewestPoints) {
    if (!reference_->surfaces) reference_->surfaces.emplace(reference_->points);
    match =
        line_match(*reference_->surfaces, points, reference_from_last_ * inverse(mount) * moved * mount, params_.lines);
  }
  if (!match || match->overlap < params_.least_overlap || match->residual > params_.most_residual)
    return end_early(points);
  reference_from_last_ = match->reference_from_sweep;
  information_ = match->information;
  last_ = sweep.stamp;
  auto pair = pair_of_last(odometry, way, params_.turn);
  if (is_far(reference_from_last_, way, params_.turn)) begin(sweep.stamp, points);
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
