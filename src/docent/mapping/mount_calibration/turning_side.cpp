#include "docent/mapping/mount_calibration/turning_side.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace docent::mapping {
namespace {

constexpr std::size_t kDirections = 180;        // of a turn
constexpr std::size_t kMostSweepsWaiting = 64;  // some seconds of the fastest scanner
constexpr double kLeastTurn = 0.35;        // [rad] between two looks: less than the delay of stamps may hide, twice
constexpr double kMostTurn = 1.05;         // [rad]: farther apart a half field has too little in common
constexpr double kMostWay = 0.3;           // [m]: driven farther they see other things
constexpr double kLongest = 4.0;           // [s]: people have changed places
constexpr int kSlack = 4;                  // directions by which the turn may err: a delay of 100 ms at 1.2 rad/s
constexpr int kFewestDirections = 40;      // in which both looked, and saw something
constexpr float kSame = 0.2F;              // [m], and
constexpr float kSameShare = 0.05F;        // of the range: the same surface
constexpr std::size_t kPairs = 12;         // of the last ones count
constexpr std::size_t kFewestPairs = 4;    // before that nothing is said
constexpr double kEnoughTurn = 2.1;        // [rad] likewise, in sum
constexpr double kLeastAgreement = 0.5;    // share of the directions: that a way of turning explains
constexpr double kLeastDifference = 0.15;  // and so much more than the other way

/// [directions] that of the beams nearest to the middle of each, in the sensor's frame.
std::vector<float> directions_of(const sensor_models::LaserReading& reading) {
  std::vector<float> ranges(kDirections, std::numeric_limits<float>::quiet_NaN());
  std::vector<double> off(kDirections, 1.0);
  for (std::size_t i = 0; i < reading.ranges.size(); ++i) {
    const float range = reading.ranges[i];
    if (std::isnan(range) || static_cast<double>(range) < reading.min_range) continue;
    const Angle bearing =
        Angle::radians(reading.first_bearing.radians() + static_cast<double>(i) * reading.bearing_step);
    const double at = (bearing.radians() / (2.0 * std::numbers::pi) + 1.0) * static_cast<double>(kDirections);
    const double nearest = std::floor(at + 0.5);
    const auto direction = static_cast<std::size_t>(nearest) % kDirections;
    if (std::abs(at - nearest) >= off[direction]) continue;
    off[direction] = std::abs(at - nearest);
    ranges[direction] =
        static_cast<double>(range) >= reading.max_range ? std::numeric_limits<float>::infinity() : range;
  }
  return ranges;
}

/// Share of the directions that agree when what was seen in direction d + shift is now seen in d; -1: too few.
double agreement(const std::vector<float>& before, const std::vector<float>& now, int shift) {
  int both = 0, agree = 0;
  for (std::size_t d = 0; d < kDirections; ++d) {
    const auto there = static_cast<std::size_t>(static_cast<int>(d + kDirections) + shift) % kDirections;
    const float a = before[there], b = now[d];
    if (std::isnan(a) || std::isnan(b) || (std::isinf(a) && std::isinf(b))) continue;
    ++both;
    agree += std::abs(a - b) <= kSame + kSameShare * std::min(a, b) ? 1 : 0;  // infinity less a range: it is none
  }
  return both < kFewestDirections ? -1.0 : static_cast<double>(agree) / both;
}

}  // namespace

void TurningSide::keep(Time stamp, const sensor_models::LaserReading& reading) {
  if (side_ == Side::right) return;  // nobody turns a scanner over while the robot is on
  waiting_.push_back({stamp, directions_of(reading), {}});
  if (waiting_.size() > kMostSweepsWaiting) waiting_.pop_front();
}

void TurningSide::forget() {
  waiting_.clear();
  reference_.reset();
}

std::optional<TurningSide::Pair> TurningSide::compared(const Look& before, const Look& now) {
  const double turn = (inverse(before.odom_from_base) * now.odom_from_base).theta.radians();
  const int shift = static_cast<int>(std::lround(turn / (2.0 * std::numbers::pi) * static_cast<double>(kDirections)));
  Pair pair{-1.0, -1.0, std::abs(turn)};
  for (int slack = -kSlack; slack <= kSlack; ++slack) {
    pair.as_said = std::max(pair.as_said, agreement(before.ranges, now.ranges, shift + slack));
    pair.mirrored = std::max(pair.mirrored, agreement(before.ranges, now.ranges, -shift + slack));
  }
  return pair.as_said < 0.0 || pair.mirrored < 0.0 ? std::nullopt : std::optional{pair};
}

void TurningSide::follow(const motion_models::OdometryHistory& odometry) {
  while (!waiting_.empty() && !odometry.empty() && waiting_.front().stamp <= odometry.latest_time()) {
    Look now = std::move(waiting_.front());
    waiting_.pop_front();
    const auto at = odometry.at(now.stamp, Duration{});
    if (!at) continue;
    now.odom_from_base = *at;
    const Pose2 moved = reference_ ? inverse(reference_->odom_from_base) * *at : Pose2{};
    const double turn = std::abs(moved.theta.radians());
    if (!reference_ || norm(moved.position()) > kMostWay || turn > kMostTurn ||
        to_seconds(now.stamp - reference_->stamp) > kLongest) {
      reference_ = std::move(now);
      continue;
    }
    if (turn < kLeastTurn) continue;
    if (const auto pair = compared(*reference_, now)) {
      pairs_.push_back(*pair);
      if (pairs_.size() > kPairs) pairs_.pop_front();
      judge();
    }
    reference_ = std::move(now);
  }
}

void TurningSide::judge() {
  Pair sum;
  for (const Pair& pair : pairs_) {
    sum.as_said += pair.as_said;
    sum.mirrored += pair.mirrored;
    sum.turn += pair.turn;
  }
  const auto count = static_cast<double>(pairs_.size());
  if (pairs_.size() < kFewestPairs || sum.turn < kEnoughTurn) return;
  const double more = (sum.mirrored - sum.as_said) / count;
  if (more >= kLeastDifference && sum.mirrored >= kLeastAgreement * count) side_ = Side::mirrored;
  if (-more >= kLeastDifference && sum.as_said >= kLeastAgreement * count) side_ = Side::right;
}

}  // namespace docent::mapping
