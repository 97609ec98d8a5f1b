#include "docent/mapping/mount_calibration/mount_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "docent/geometry/point_transform.h"

namespace docent::mapping {
namespace {

constexpr double kMostCounted = 9.0;      // squared sigmas of a pair, in the mean
constexpr double kUsualMisfit = 3.0;      // of a pair's three measurements
constexpr int kHeadings = 12;             // from which the search may begin
constexpr std::size_t kFewestPieces = 4;  // of which a scatter can be told

MountState moved(MountState state, const MountVector& step) {
  state.base_from_sensor.x += step[kMountX];
  state.base_from_sensor.y += step[kMountY];
  state.base_from_sensor.theta = state.base_from_sensor.theta + Angle::radians(step[kMountHeading]);
  state.delay = std::clamp(state.delay + step[kMountDelay], -ShiftedMotion::kMost, ShiftedMotion::kMost);
  state.way_scale = std::clamp(state.way_scale + step[kWayScale], 0.5, 2.0);
  state.turn_scale = std::clamp(state.turn_scale + step[kTurnScale], 0.5, 2.0);
  state.veer += step[kVeer];
  return state;
}

MountVector difference(const MountState& a, const MountState& b) {
  MountVector d;
  d[kMountX] = a.base_from_sensor.x - b.base_from_sensor.x;
  d[kMountY] = a.base_from_sensor.y - b.base_from_sensor.y;
  d[kMountHeading] = (a.base_from_sensor.theta - b.base_from_sensor.theta).radians();
  d[kMountDelay] = a.delay - b.delay;
  d[kWayScale] = a.way_scale - b.way_scale;
  d[kTurnScale] = a.turn_scale - b.turn_scale;
  d[kVeer] = a.veer - b.veer;
  return d;
}

/// A pose whose cosine and sine are at hand.
struct PoseTransform {
  explicit PoseTransform(const Pose2& a_from_b) : transform{a_from_b}, theta{a_from_b.theta} {}
  [[nodiscard]] Pose2 operator*(const Pose2& b_from_c) const {
    const auto [x, y] = transform * b_from_c.position();
    return {x, y, theta + b_from_c.theta};
  }
  PointTransform transform;
  Angle theta;
};

/// What is the same for all pairs: the state, its mount's inverse.
struct StateAt {
  explicit StateAt(const MountState& here) : state{here}, sensor_from_base{inverse(here.base_from_sensor)} {}
  MountState state;
  PoseTransform sensor_from_base;
};

/// What is the same for all states of one delay: a pair's motion as scans see it and as odometry says.
struct PairAt {
  PairAt(const MotionPair& pair, double delay)
      : base{pair.base.at(delay)},
        // Whoever turned more than odometry says did so all along the way: by half of it in the mean.
        half{{0.0, 0.0, Angle::radians(0.5 * (pair.sensor_then_from_now.theta.radians() - base.theta.radians()))}},
        sensor_now_from_then{inverse(pair.sensor_then_from_now)} {}
  Pose2 base;
  PointTransform half;
  PoseTransform sensor_now_from_then;
};

/// What scans see of the base's motion against what they should see, in the frame of the later sweep.
Eigen::Vector3d residual(const PairAt& pair, const StateAt& at) {
  const MountState& state = at.state;
  const double turn = state.turn_scale * pair.base.theta.radians() + state.veer * pair.base.x;
  const Point2 place = pair.half * (state.way_scale * pair.base.position());
  const Pose2 base{place.x, place.y, Angle::radians(turn)};
  const Pose2 off = pair.sensor_now_from_then * (at.sensor_from_base * base * state.base_from_sensor);
  return {off.x, off.y, off.theta.radians()};
}

Eigen::Matrix3d information_of(const MotionPair& pair, Angle heading, const MountFitParams& params) {
  const Pose2 base = pair.base.at(0.0);
  const double metres = norm(base.position());
  const double least = params.least_noise * params.least_noise;
  const double along = params.way_noise * params.way_noise * metres + least;
  const double aside = params.aside_noise * params.aside_noise * metres + least;
  const double c = std::cos(heading.radians());
  const double s = std::sin(heading.radians());
  const double turn = params.turn_noise * params.turn_noise * std::abs(base.theta.radians()) +
                      params.least_turn_noise * params.least_turn_noise;
  Eigen::Matrix3d covariance = pair.information.inverse();
  // The base drives along its own x axis, which lies at -heading in the sensor's frame.
  covariance(0, 0) += c * c * along + s * s * aside;
  covariance(1, 1) += s * s * along + c * c * aside;
  covariance(0, 1) += c * s * (aside - along);
  covariance(1, 0) += c * s * (aside - along);
  covariance(2, 2) += turn;
  return covariance.inverse();
}

struct WeighedPair {
  const MotionPair* pair;
  Eigen::Matrix3d information;
};

/// @param most  a cost that is no less need not be told to its end
double robust_cost(std::span<const WeighedPair> pairs, const MountState& state, double outlier,
                   double most = std::numeric_limits<double>::infinity()) {
  const double square = outlier * outlier;
  const StateAt at{state};
  double cost = 0.0;
  for (const WeighedPair& weighed : pairs) {
    const Eigen::Vector3d r = residual(PairAt{*weighed.pair, state.delay}, at);
    cost += square * std::log1p(r.dot(weighed.information * r) / square);
    if (cost >= most) break;
  }
  return cost;
}

/// What a pair says of the state near one: its residual there, how that changes, and its weight.
struct LinearPair {
  Eigen::Vector3d residual;
  Eigen::Matrix<double, 3, kMountUnknowns> rows;
  Eigen::Matrix3d information;
};

std::vector<LinearPair> linearised(std::span<const WeighedPair> pairs, const MountState& state) {
  constexpr std::array<double, kMountUnknowns> kSteps{1e-4, 1e-4, 1e-4, 1e-3, 1e-4, 1e-4, 1e-4};
  const StateAt here{state};
  std::vector<StateAt> beside;
  for (int i = 0; i < kMountUnknowns; ++i) {
    MountVector step = MountVector::Zero();
    step[i] = kSteps[static_cast<std::size_t>(i)];
    beside.emplace_back(moved(state, step));
  }
  std::vector<LinearPair> linear;
  linear.reserve(pairs.size());
  for (const WeighedPair& weighed : pairs) {
    LinearPair& one = linear.emplace_back();
    const PairAt pair{*weighed.pair, state.delay};
    const PairAt later{*weighed.pair, beside[kMountDelay].state.delay};
    one.information = weighed.information;
    one.residual = residual(pair, here);
    for (std::size_t i = 0; i < beside.size(); ++i)
      one.rows.col(static_cast<Eigen::Index>(i)) =
          (residual(i == kMountDelay ? later : pair, beside[i]) - one.residual) / kSteps[i];
  }
  return linear;
}

/// Some of the pairs: all but those of [without, end).
struct Left {
  std::size_t without = 0;
  std::size_t end = 0;
  [[nodiscard]] bool has(std::size_t i) const { return i < without || i >= end; }
};

struct NormalEquations {
  MountMatrix information;
  MountVector pull;
};

/// Information and the pull on the state that is `step` beside the one at which the pairs were made linear, with
/// weights that fall with the residual there.
NormalEquations normal_equations(std::span<const LinearPair> pairs, Left left, const MountVector& step,
                                 const MountVector& off_prior, const MountPrior& prior, double outlier) {
  NormalEquations sums;
  const MountVector weights = prior.sigma.cwiseAbs2().cwiseInverse();
  sums.information = weights.asDiagonal();
  sums.pull = weights.cwiseProduct(off_prior + step);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!left.has(i)) continue;
    const LinearPair& one = pairs[i];
    const Eigen::Vector3d r = one.residual + one.rows * step;
    const double weight = 1.0 / (1.0 + r.dot(one.information * r) / (outlier * outlier));
    const Eigen::Matrix<double, kMountUnknowns, 3> weighed = weight * one.rows.transpose() * one.information;
    sums.information += weighed * one.rows;
    sums.pull += weighed * r;
  }
  return sums;
}

/// The heading from which the search ends best: with a scanner that looks elsewhere the nearest one may be none.
MountState first_state(std::span<const WeighedPair> pairs, const MountPrior& prior, double outlier) {
  MountState best = prior.state;
  double least = robust_cost(pairs, best, outlier);
  for (int i = 1; i < kHeadings; ++i) {
    MountState state = prior.state;
    const Angle turned = Angle::radians(2.0 * std::numbers::pi * i / kHeadings);
    state.base_from_sensor.theta = state.base_from_sensor.theta + turned;
    const double unlikely = turned.radians() / prior.sigma[kMountHeading];
    const double cost = robust_cost(pairs, state, outlier, least) + unlikely * unlikely;
    if (cost < least) {
      least = cost;
      best = state;
    }
  }
  return best;
}

std::vector<WeighedPair> weighed_pairs(std::span<const MotionPair> pairs, Angle heading, const MountFitParams& params) {
  std::vector<WeighedPair> weighed;
  weighed.reserve(pairs.size());
  for (const MotionPair& pair : pairs) weighed.push_back({&pair, information_of(pair, heading, params)});
  return weighed;
}

/// Of least robust cost, from whatever heading.
MountState best_state(std::span<const MotionPair> pairs, const MountPrior& prior, const MountFitParams& params) {
  auto weighed = weighed_pairs(pairs, prior.state.base_from_sensor.theta, params);
  MountState state = first_state(weighed, prior, params.outlier);
  for (int i = 0; i < params.iterations; ++i) {
    if (i <= 1)  // how odometry errs lies along the base's way, as far as that is known by now
      weighed = weighed_pairs(pairs, state.base_from_sensor.theta, params);
    const NormalEquations sums = normal_equations(linearised(weighed, state), {}, MountVector::Zero(),
                                                  difference(state, prior.state), prior, params.outlier);
    const MountVector step = -sums.information.ldlt().solve(sums.pull);
    state = moved(state, step);
    if (step.cwiseAbs().maxCoeff() < 1e-6) break;
  }
  return state;
}

/// How far the estimate goes without some of its pairs, near where it is.
MountVector nearby_step(std::span<const LinearPair> pairs, Left left, const MountVector& off_prior,
                        const MountPrior& prior, double outlier) {
  constexpr int kIterations = 4;
  MountVector step = MountVector::Zero();
  for (int i = 0; i < kIterations; ++i) {
    const NormalEquations sums = normal_equations(pairs, left, step, off_prior, prior, outlier);
    step -= sums.information.ldlt().solve(sums.pull);
  }
  return step;
}

/// Standard deviations by how far the pieces of the way contradict one another: pairs of one corridor err alike, which
/// least squares takes for as many witnesses. The mount is fitted anew without each piece in turn (jackknife over
/// clusters: K.-Y. Liang and S. Zeger, Biometrika 1986, for clusters; B. Efron, 1982, for the jackknife), for weights
/// that fall with the residual tell less than they seem to. Few pieces scatter by chance: as Student's t does.
/// Of few pairs the fit without one may end elsewhere, so it is searched anew. Zero: too few pieces.
MountVector scatter(std::span<const MotionPair> pairs, std::span<const LinearPair> linear, const MountState& state,
                    const MountPrior& prior, const MountFitParams& params) {
  const std::size_t size = std::clamp(pairs.size() / static_cast<std::size_t>(params.pieces), std::size_t{1},
                                      static_cast<std::size_t>(params.piece));
  const std::size_t pieces = pairs.size() / size;  // what is left over belongs to the last one
  if (pieces < kFewestPieces) return MountVector::Zero();
  const MountVector off_prior = difference(state, prior.state);
  MountVector squares = MountVector::Zero();
  for (std::size_t k = 0; k < pieces; ++k) {
    const Left left{k * size, k + 1 == pieces ? pairs.size() : (k + 1) * size};
    if (pairs.size() > static_cast<std::size_t>(params.few_pairs)) {
      squares += nearby_step(linear, left, off_prior, prior, params.outlier).cwiseAbs2();
      continue;
    }
    std::vector<MotionPair> rest(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(left.without));
    rest.insert(rest.end(), pairs.begin() + static_cast<std::ptrdiff_t>(left.end), pairs.end());
    squares += difference(best_state(rest, prior, params), state).cwiseAbs2();
  }
  const auto count = static_cast<double>(pieces);
  const double student = (count - 1.0) / (count - 3.0);
  return (student * (count - 1.0) / count * squares).cwiseSqrt();
}

}  // namespace

MountPrior vague_prior(const Pose2& base_from_sensor, const MountFitParams& params) {
  MountPrior prior{{.base_from_sensor = base_from_sensor}, {}};
  prior.sigma[kMountX] = prior.sigma[kMountY] = params.position_prior;
  prior.sigma[kMountHeading] = params.heading_prior;
  prior.sigma[kMountDelay] = params.delay_prior;
  prior.sigma[kWayScale] = params.way_prior;
  prior.sigma[kTurnScale] = params.turn_prior;
  prior.sigma[kVeer] = params.veer_prior;
  return prior;
}

double MountEstimate::sigma(MountUnknown unknown) const { return std::sqrt(covariance(unknown, unknown)); }

double MountEstimate::sigma_position() const { return std::max(sigma(kMountX), sigma(kMountY)); }

double residual_of(const MotionPair& pair, const MountState& state, const MountFitParams& params) {
  const Eigen::Vector3d r = residual(PairAt{pair, state.delay}, StateAt{state});
  return r.dot(information_of(pair, state.base_from_sensor.theta, params) * r);
}

MountEstimate fit_mount(std::span<const MotionPair> pairs, const MountPrior& prior, const MountFitParams& params) {
  MountEstimate estimate{.state = best_state(pairs, prior, params)};
  const auto linear = linearised(weighed_pairs(pairs, estimate.state.base_from_sensor.theta, params), estimate.state);
  const NormalEquations sums =
      normal_equations(linear, {}, MountVector::Zero(), difference(estimate.state, prior.state), prior, params.outlier);
  for (const LinearPair& one : linear)
    estimate.misfit += std::min(kMostCounted, one.residual.dot(one.information * one.residual));
  if (!linear.empty()) estimate.misfit /= static_cast<double>(linear.size());
  // Where most pairs contradict the estimate, it may be that of the wrong ones: worse than by the root of their
  // squares.
  const double worse = params.caution * std::max(1.0, estimate.misfit / kUsualMisfit);
  estimate.covariance = worse * worse * sums.information.inverse();
  const MountVector apart = scatter(pairs, linear, estimate.state, prior, params);
  for (int i = 0; i < kMountUnknowns; ++i) {
    const double larger = std::max(1.0, apart[i] / estimate.sigma(static_cast<MountUnknown>(i)));
    estimate.covariance.row(i) *= larger;
    estimate.covariance.col(i) *= larger;
  }
  return estimate;
}

}  // namespace docent::mapping
