#include "docent/collision_avoidance/expected_sweeps/parallax.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "docent/geometry/point_transform.h"

namespace docent::collision_avoidance {
namespace {

constexpr double kNotExpected = std::numeric_limits<double>::infinity();
constexpr int kParallaxSteps = 5;     // of Gauss-Newton
constexpr int kWideSteps = 2;         // of them while much is still off
constexpr double kWide = 3.0;         // of the noise: half of the weight is lost near here, at first
constexpr double kNarrow = 2.0;       // and later
constexpr double kLongestStep = 0.3;  // [m], [rad]
constexpr double kLeastRange = 0.1;   // [m] of what is left without the offset
constexpr double kMostSamplesJoined = 4.0;
constexpr double kOffsetPrior = 1.0;                                // [m]
const std::array<double, 4> kDifferences{0.01, 0.01, 0.004, 0.05};  // [m] [m] [rad] [m]

/// Motion and offset: x, y [m] and heading [rad] of the sensor then, seen from the sensor now; the offset [m].
using Unknowns = Eigen::Vector4d;

class Parallax {
 public:
  Parallax(const SweepView& then, const SweepView& now, const ParallaxParams& params)
      : then_{then}, now_{now}, params_{params} {}

  [[nodiscard]] std::optional<ParallaxOffset> solve(const Pose2& now_from_then) {
    const double turn = now_from_then.theta.radians();
    const double way_sigma = params_.way_error + params_.way_share * norm(now_from_then.position());
    const double turn_sigma = params_.turn_error + params_.turn_share * std::abs(turn);
    const Unknowns by_odometry{now_from_then.x, now_from_then.y, turn, 0.0};
    const Unknowns prior = Unknowns{way_sigma, way_sigma, turn_sigma, kOffsetPrior}.cwiseInverse().cwiseAbs2().eval();
    Unknowns found = by_odometry;
    for (int step = 0; step < kParallaxSteps; ++step) {
      if (!linearize(found, step < kWideSteps ? kWide : kNarrow)) return std::nullopt;
      information_ += prior.asDiagonal();
      gradient_ += prior.cwiseProduct(by_odometry - found);
      const Unknowns change = information_.ldlt().solve(gradient_);
      found += change.cwiseMax(-kLongestStep).cwiseMin(kLongestStep);
      if (!(std::abs(found[3]) <= params_.most_offset)) return std::nullopt;
    }
    const double variance = information_.ldlt().solve(Unknowns::Unit(3))[3];
    return ParallaxOffset{found[3], std::sqrt(std::max(0.0, variance)), agreeing_ / compared_};
  }

 private:
  /// Evidence of all samples that are compared. False: of too few.
  bool linearize(const Unknowns& at, double robust) {
    expect(at, expected_);
    for (int k = 0; k < 4; ++k) {
      Unknowns other = at;
      other[k] += kDifferences[static_cast<std::size_t>(k)];
      expect(other, varied_[static_cast<std::size_t>(k)]);
    }
    information_.setZero();
    gradient_.setZero();
    agreeing_ = 0.0;
    compared_ = 0;
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      if (!now_.met(i) || expected_[i] == kNotExpected) continue;
      Unknowns slope;
      for (int k = 0; k < 4; ++k) {
        const auto part = static_cast<std::size_t>(k);
        slope[k] = (varied_[part][i] - expected_[i]) / kDifferences[part];
      }
      const bool is_surface = std::abs(slope[3]) <= params_.steepest && std::abs(slope[0]) <= params_.steepest_way &&
                              std::abs(slope[1]) <= params_.steepest_way && std::isfinite(slope[2]);
      if (!is_surface) continue;
      const auto reading = static_cast<double>(now_.ranges[i]);
      const double slanted = params_.per_slant * now_.bearing_step * slope[2];
      const double noise = std::hypot(params_.noise + params_.per_metre * reading, slanted);
      const double off = reading - expected_[i];
      const double scaled = off / (robust * noise);
      const double trust = 1.0 / ((1.0 + scaled * scaled) * (1.0 + scaled * scaled));
      const double weight = trust / (noise * noise);
      information_ += weight * slope * slope.transpose();
      gradient_ += weight * off * slope;
      agreeing_ += trust;
      ++compared_;
    }
    return compared_ >= params_.least;
  }

  /// What the samples now should read, by what was seen then: between two neighbours of one thing along a straight
  /// line.
  void expect(const Unknowns& at, std::vector<double>& ranges) const {
    ranges.assign(now_.ranges.size(), kNotExpected);
    const double offset = at[3];
    const PointTransform moves{Pose2{at[0], at[1], Angle::radians(at[2])}};
    struct Seen {
      double sample;  ///< of now, and parts
      double inverse_range;
      double reading;  ///< then
    };
    std::optional<Seen> before;
    for (std::size_t i = 0; i < then_.ranges.size(); ++i) {
      const auto reading = static_cast<double>(then_.ranges[i]);
      if (!then_.met(i) || reading - offset < kLeastRange) {
        before.reset();
        continue;
      }
      const Point2 place = moves * ((reading - offset) * then_.rays->units[i]);
      const double bearing = std::remainder(std::atan2(place.y, place.x) - now_.first_bearing, 2.0 * std::numbers::pi);
      const double positive = bearing < -now_.bearing_step ? bearing + 2.0 * std::numbers::pi : bearing;
      const Seen seen{positive / now_.bearing_step, 1.0 / std::max(1e-3, norm(place)), reading};
      if (before && is_one_thing(*before, seen)) {
        for (double sample = std::max(0.0, std::ceil(before->sample)); sample <= seen.sample; sample += 1.0) {
          const auto at_sample = static_cast<std::size_t>(sample);
          if (at_sample >= ranges.size()) break;
          const double part = (sample - before->sample) / (seen.sample - before->sample);
          const double inverse_range = (1.0 - part) * before->inverse_range + part * seen.inverse_range;
          ranges[at_sample] = std::min(ranges[at_sample], 1.0 / inverse_range + offset);
        }
      }
      before = seen;
    }
  }

  template <typename Seen>
  [[nodiscard]] bool is_one_thing(const Seen& before, const Seen& seen) const {
    const double apart = seen.sample - before.sample;
    const double spacing = then_.bearing_step * std::max(seen.reading, before.reading);
    return apart > 0.0 && apart < kMostSamplesJoined &&
           std::abs(seen.reading - before.reading) <= params_.joins + params_.joins_steps * spacing;
  }

  const SweepView& then_;
  const SweepView& now_;
  const ParallaxParams& params_;
  std::vector<double> expected_;
  std::array<std::vector<double>, 4> varied_;
  Eigen::Matrix4d information_;
  Unknowns gradient_;
  double agreeing_ = 0.0;
  int compared_ = 0;
};

}  // namespace

std::optional<ParallaxOffset> offset_by_parallax(const SweepView& then, const SweepView& now,
                                                 const Pose2& now_from_then, const ParallaxParams& params) {
  return Parallax{then, now, params}.solve(now_from_then);
}

bool ParallaxCheck::keep(const SweepView& view) {
  if (trail_.empty()) {
    trail_.push_back(view);
    return false;
  }
  const Pose2 since = inverse(trail_.back().odom_from_sensor) * view.odom_from_sensor;
  const bool is_elsewhere = norm(since.position()) >= params_.between;
  const bool is_news = std::abs(since.theta.radians()) >= params_.news_turn ||
                       view.stamp - trail_.back().stamp >= seconds(params_.news_time);
  if (!is_elsewhere && is_news) trail_.back() = view;
  if (is_elsewhere) trail_.push_back(view);
  while (view.stamp - trail_.front().stamp > seconds(params_.longest)) trail_.pop_front();
  return is_elsewhere;
}

ParallaxCheck::Finding ParallaxCheck::judge() {
  if (static_cast<int>(pairs_.size()) < params_.least_pairs) return Finding::nothing;
  const auto error_of = [&](const ParallaxOffset& pair) { return std::max(pair.error, params_.least_error); };
  const auto weight_of = [&](const ParallaxOffset& pair) { return 1.0 / (error_of(pair) * error_of(pair)); };
  double weights = 0.0;
  double sum = 0.0;
  for (const ParallaxOffset& pair : pairs_) {
    weights += weight_of(pair);
    sum += weight_of(pair) * pair.offset;
  }
  offset_ = sum / weights;
  double agreeing = 0.0;
  double scatter = 0.0;
  for (const ParallaxOffset& pair : pairs_) {
    const double off = pair.offset - offset_;
    scatter += weight_of(pair) * off * off / (static_cast<double>(pairs_.size()) - 1.0);
    if (std::abs(off) <= params_.same + 2.0 * error_of(pair)) agreeing += weight_of(pair);
  }
  if (agreeing < params_.agree * weights || scatter > params_.most_scatter) return Finding::nothing;
  const double error = params_.sure * std::hypot(params_.least_error, std::sqrt(std::max(1.0, scatter) / weights));
  if (std::abs(offset_) <= params_.in_order)
    return error <= params_.least_offset ? Finding::in_order : Finding::nothing;
  return std::abs(offset_) >= std::max(params_.least_offset, error) ? Finding::offset : Finding::nothing;
}

ParallaxCheck::Finding ParallaxCheck::add(const SweepView& view) {
  if (was_in_order_ || !keep(view)) return Finding::nothing;
  const auto from = std::find_if(trail_.rbegin(), trail_.rend(), [&](const SweepView& then) {
    return norm(then.odom_from_sensor.position() - view.odom_from_sensor.position()) >= params_.least_way;
  });
  if (from == trail_.rend()) return Finding::nothing;
  const Pose2 now_from_then = inverse(view.odom_from_sensor) * from->odom_from_sensor;
  const bool is_comparable = norm(now_from_then.position()) <= params_.farthest &&
                             std::abs(now_from_then.theta.radians()) <= params_.most_turn;
  if (!is_comparable) return Finding::nothing;
  const auto pair = offset_by_parallax(*from, view, now_from_then, params_.pair);
  if (!pair || pair->share < params_.share) return Finding::nothing;
  pairs_.push_back(*pair);
  if (static_cast<int>(pairs_.size()) > params_.most_pairs) pairs_.pop_front();
  const Finding finding = judge();
  was_in_order_ = finding == Finding::in_order;
  return finding;
}

}  // namespace docent::collision_avoidance
