#include "docent/localization/belief/pose_refiner.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "docent/localization/belief/pose_search.h"

namespace docent::localization {
namespace {

constexpr double kVagueTurn = 0.052;  // [rad] deviation by odometry: the belief is the better beginning
constexpr double kFar = 0.1;          // [m] deviation by odometry, or
constexpr double kFarTurn = 0.12;     // [rad]: a gradient would lead anywhere

constexpr double kUnknownAllowance = 0.3;  // [m]
constexpr std::size_t kMostBeams = 120;
constexpr std::size_t kFewestBeams = 10;
constexpr double kGateDeviations = 2.0;  // of the prior, by which a wall may be off at first
constexpr double kWidestGate = 0.8;      // [m]
constexpr double kTornApart = 1.4;       // times the farthest: more, and the belief is right
constexpr double kWidestMode = 0.5;      // [m] standard deviation; wider ones have no inside to speak of

// A search for the pose, see best_pose_near:
constexpr double kSearchedWithin = 2.0;     // [m] of the mode: farther off the belief has left where odometry leads
constexpr double kSearchedViews = 2.5;      // what its sweep is worth, in sweeps of every quarter of a metre
constexpr double kSearchedPosition = 0.02;  // [m2] and
constexpr double kSearchedTurn = 0.002;     // [rad2] that the guesses may be off beyond what they say

/// A piece of wall: where a ray meets it, and its normal.
struct Wall {
  Point2 at;      ///< [m] map
  Point2 normal;  ///< unit
};

/// The wall that a ray from `from` meets. Its direction comes from two rays beside it, some 20 cm apart on the wall;
/// none where the three do not lie on a line.
std::optional<Wall> wall_at(const sensor_models::RayCaster& caster, Point2 from, Angle direction, double max_range) {
  const double behind = 0.5 * caster.frame().resolution;
  const auto hit = [&](Angle at) -> std::optional<Point2> {
    const auto range = caster.cast(from, unit(at), max_range, kUnknownAllowance);
    if (!range || *range >= max_range) return std::nullopt;
    return from + (*range + behind) * unit(at);
  };
  const auto middle = hit(direction);
  if (!middle) return std::nullopt;
  const Angle aside = Angle::radians(std::clamp(0.2 / std::max(distance(from, *middle), 0.1), 0.02, 0.12));
  const auto left = hit(direction + aside);
  const auto right = hit(direction - aside);
  if (!left || !right) return std::nullopt;
  const Point2 along = *left - *right;
  const double length = norm(along);
  if (length < 0.05 || length > 1.5) return std::nullopt;
  const Point2 normal = (1.0 / length) * Point2{-along.y, along.x};
  const Point2 centre = (1.0 / 3.0) * (*left + *middle + *right);  // averages the map's steps
  if (std::abs(dot(normal, *middle - *left)) > 0.06) return std::nullopt;
  return Wall{centre, normal};
}

/// Where the belief has a mode. Wider than the mode: the belief is of this sweep, too, which shall not count twice.
PoseGuess guess_of(const BeliefMode& mode) {
  return {mode.map_from_robot, std::sqrt(mode.covariance[0] + mode.covariance[4] + kSearchedPosition),
          std::sqrt(2.0 * mode.covariance[8] + kSearchedTurn)};
}

Eigen::Matrix3d matrix(const std::array<double, 9>& values) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data());
}

std::array<double, 9> values(const Eigen::Matrix3d& matrix) {
  std::array<double, 9> result{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.data()) = matrix;
  return result;
}

}  // namespace

Result<void> PoseRefinerParams::validate() const {
  if (!(gate > 0.0 && beam_sigma > 0.0)) return fail("refiner.gate and beam_sigma must be > 0");
  if (!(independent_beams > 0.0)) return fail("refiner.independent_beams must be > 0");
  if (!(farthest > 0.0 && farthest_turn > 0.0)) return fail("refiner.farthest and farthest_turn must be > 0");
  return {};
}

/// Covariance intersection ([Julier1997]): both are of the same readings and nobody knows how much, so neither
/// counts in full. What is sharp wins: the refined pose beside walls, the belief where only odometry is left of it.
PoseRefiner::Estimate PoseRefiner::intersection(const Estimate& a, const Estimate& b) {
  const Eigen::Matrix3d of_a = matrix(a.covariance).inverse();
  const Eigen::Matrix3d of_b = matrix(b.covariance).inverse();
  constexpr int kSteps = 10;
  double share = 1.0, most = -1.0;
  for (int step = kSteps; step >= 0; --step) {
    const double candidate = static_cast<double>(step) / kSteps;
    const double determinant = (candidate * of_a + (1.0 - candidate) * of_b).determinant();
    if (determinant <= most) continue;
    most = determinant;
    share = candidate;
  }
  const Eigen::Matrix3d information = share * of_a + (1.0 - share) * of_b;
  const Pose2& from = a.map_from_robot;
  const Pose2& to = b.map_from_robot;
  const Eigen::Vector3d off{to.x - from.x, to.y - from.y, (to.theta - from.theta).radians()};
  const Eigen::Vector3d change = information.ldlt().solve((1.0 - share) * of_b * off);
  return {{from.x + change[0], from.y + change[1], from.theta + Angle::radians(change[2])},
          values(information.inverse())};
}

bool PoseRefiner::is_in(const BeliefMode& mode, const Pose2& pose, double times, double spread) const {
  return distance(pose.position(), mode.map_from_robot.position()) <= std::max(times * params_.farthest, spread) &&
         std::abs((pose.theta - mode.map_from_robot.theta).degrees()) <= times * params_.farthest_turn;
}

void PoseRefiner::carry_on(const Pose2& before_from_after, double position_variance, double heading_variance) {
  if (!estimate_) return;
  const Pose2 before = estimate_->map_from_robot;
  const Pose2 after = before * before_from_after;
  Eigen::Matrix3d moved = Eigen::Matrix3d::Identity();
  moved(0, 2) = -(after.y - before.y);
  moved(1, 2) = after.x - before.x;
  Eigen::Matrix3d covariance = moved * matrix(estimate_->covariance) * moved.transpose();
  covariance.diagonal() += Eigen::Vector3d{position_variance, position_variance, heading_variance};
  covariance.diagonal().array() += 1e-8;
  estimate_ = Estimate{after, values(covariance)};
}

Pose2 PoseRefiner::searched(const BeliefMode& mode, const sensor_models::RangeSweep& sweep, double position_variance,
                            double heading_variance, const sensor_models::RayCaster& caster, double max_range) {
  // After a long way odometry knows the pose less well than the belief does: then the belief's is the better beginning,
  // and the readings are asked which pose in it, or where odometry expected it, they fit best. Walls of a corridor look
  // alike every few decimetres: from a wrong beginning no gradient leads to the right place.
  std::vector<PoseGuess> guesses{guess_of(mode)};
  if (estimate_ && distance(estimate_->map_from_robot.position(), mode.map_from_robot.position()) < kSearchedWithin)
    guesses.push_back({estimate_->map_from_robot, std::sqrt(position_variance + kSearchedPosition),
                       std::sqrt(heading_variance + kSearchedTurn)});
  const FoundPose found = best_pose_near(guesses, sweep, caster, max_range, kSearchedViews * params_.independent_beams);
  found_share_ = found.share;
  estimate_ = corrected({found.map_from_robot, values(Eigen::Vector3d{0.01, 0.01, 0.001}.asDiagonal())}, sweep, caster,
                        max_range, false);
  return estimate_->map_from_robot;
}

Pose2 PoseRefiner::refine(const BeliefMode& mode, const sensor_models::RangeSweep& sweep,
                          const Pose2& before_from_after, double position_variance, double heading_variance,
                          const sensor_models::RayCaster& caster, double max_range) {
  found_share_.reset();
  if (!params_.enabled || mode.covariance[0] + mode.covariance[4] > kWidestMode * kWidestMode) {
    estimate_.reset();
    return mode.map_from_robot;
  }
  carry_on(before_from_after, position_variance, heading_variance);
  Eigen::Matrix3d wide = matrix(mode.covariance);
  wide.diagonal() += Eigen::Vector3d{0.003, 0.003, 0.0005};
  const Estimate of_mode{mode.map_from_robot, values(wide)};

  if (position_variance > kFar * kFar || heading_variance > kFarTurn * kFarTurn)
    return searched(mode, sweep, position_variance, heading_variance, caster, max_range);
  const bool is_vague = heading_variance > kVagueTurn * kVagueTurn;
  if (estimate_ && !is_vague) {
    const Estimate kept = intersection(corrected(*estimate_, sweep, caster, max_range, false), of_mode);
    if (is_in(mode, kept.map_from_robot, 1.0, 0.0)) {
      estimate_ = kept;
      return kept.map_from_robot;
    }
    // People before the walls push belief and refined pose apart. The readings tell which of them knows better.
    if (is_in(mode, kept.map_from_robot, kTornApart, 0.0)) {
      const Estimate begun = corrected(of_mode, sweep, caster, max_range, false);
      const auto fit_of_kept = log_fit(kept.map_from_robot, sweep, caster, max_range);
      if (fit_of_kept && *fit_of_kept > log_fit(begun.map_from_robot, sweep, caster, max_range)) {
        estimate_ = kept;
        return kept.map_from_robot;
      }
    }
  }
  estimate_ = corrected(of_mode, sweep, caster, max_range, is_vague);
  if (is_in(mode, estimate_->map_from_robot, 1.0,
            is_vague ? 1.5 * std::sqrt(mode.covariance[0] + mode.covariance[4]) : 0.0))
    return estimate_->map_from_robot;
  estimate_.reset();
  return mode.map_from_robot;
}

PoseRefiner::Estimate PoseRefiner::corrected(const Estimate& predicted, const sensor_models::RangeSweep& sweep,
                                             const sensor_models::RayCaster& caster, double max_range,
                                             bool is_vague) const {
  const Eigen::Matrix3d prior = matrix(predicted.covariance);
  const Eigen::Matrix3d prior_information = prior.inverse();
  const Pose2& begin = predicted.map_from_robot;
  Pose2 pose = begin;
  Eigen::Matrix3d information = prior_information;
  const std::size_t step = std::max<std::size_t>(1, sweep.beams.size() / kMostBeams);
  // A vague beginning is drawn in from farther away, step by step.
  const int iterations = is_vague ? 6 : 3;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const double gate = params_.gate * std::max(1, iterations - 2 - iteration);
    Eigen::Matrix3d wall_information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d pull = Eigen::Vector3d::Zero();
    std::size_t count = 0;
    for (std::size_t i = 0; i < sweep.beams.size(); i += step) {
      const sensor_models::SweepBeam& beam = sweep.beams[i];
      if (beam.no_return || beam.range >= max_range || beam.range < 0.3) continue;
      const auto wall = wall_at(caster, pose.position(), pose.theta + Angle::radians(beam.bearing), max_range);
      if (!wall) continue;
      const Point2 end = pose * sensor_models::endpoint(beam);
      const Point2 arm = end - pose.position();
      const Eigen::Vector3d gradient{wall->normal.x, wall->normal.y, dot(wall->normal, Point2{-arm.y, arm.x})};
      const double residual = dot(wall->normal, end - wall->at);
      // At first the walls may be as far off as the pose may be: far ones are when the heading has drifted.
      const double doubt = iteration == 0 ? kGateDeviations * std::sqrt(gradient.dot(prior * gradient)) : 0.0;
      const double wide = std::max(gate, std::min(doubt, kWidestGate));
      if (std::abs(residual) > wide || distance(end, wall->at) > 3.0 * wide) continue;
      // Cauchy: what lies far off counts little.
      const double scaled = residual / (2.0 * params_.beam_sigma);
      const double weight = 1.0 / (1.0 + scaled * scaled);
      wall_information += weight * gradient * gradient.transpose();
      pull -= weight * residual * gradient;
      ++count;
    }
    if (count < kFewestBeams) {
      pose = begin;
      information = prior_information;
      break;
    }
    const double share = std::min(1.0, params_.independent_beams / static_cast<double>(count)) /
                         (params_.beam_sigma * params_.beam_sigma);
    information = prior_information + share * wall_information;
    const Eigen::Vector3d off{pose.x - begin.x, pose.y - begin.y, (pose.theta - begin.theta).radians()};
    const Eigen::Vector3d change = information.ldlt().solve(share * pull - prior_information * off);
    pose = {pose.x + change[0], pose.y + change[1], pose.theta + Angle::radians(change[2])};
    if (iteration > 0 && gate <= params_.gate && change.head<2>().norm() < 0.001 && std::abs(change[2]) < 0.0005) break;
  }
  return {pose, values(information.inverse())};
}

}  // namespace docent::localization
