#include "docent/localization/sonar/tracker/sweep_match.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::localization {
namespace {

constexpr int kRays = 5;               // across a cone
constexpr int kCoarseRays = 3;         // on the lattice
constexpr int kSteps = 2;              // of the lattice to each side
constexpr int kIterations = 6;         // of Gauss-Newton
constexpr std::size_t kBasins = 4;     // places of the lattice that are refined
constexpr double kApart = 0.15;        // [m] between two answers that are not the same
constexpr double kTurnedApart = 0.07;  // [rad]

class Matcher {
 public:
  Matcher(const SweepMatchParams& params, const EchoMap& map, const std::vector<PlacedEcho>& echoes, const Pose2& prior,
          const PoseMatrix& covariance)
      : params_{params},
        map_{map},
        echoes_{echoes},
        prior_{prior},
        covariance_{covariance},
        information_{inverse_of(covariance)} {}

  SweepMatch run() const {
    SweepMatch best;
    if (echoes_.size() < static_cast<std::size_t>(params_.echoes)) return best;
    double best_cost = 0.0;
    double rival = 1e300;
    std::vector<Pose2> found;
    std::vector<double> costs;
    for (const Pose2& start : basins()) {
      const Pose2 refined = refine(start);
      found.push_back(refined);
      costs.push_back(cost(refined, kRays));
    }
    const auto winner = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    best_cost = costs[winner];
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto d = difference(found[i], found[winner]);
      if (std::hypot(d[0], d[1]) > kApart || std::abs(d[2]) > kTurnedApart) rival = std::min(rival, costs[i]);
    }
    judge(found[winner], best);
    if (best.outcome == MatchOutcome::matched && rival - best_cost < params_.distinct) {
      best.outcome = MatchOutcome::ambiguous;
    }
    return best;
  }

 private:
  struct Comparison {
    double error = 0.0;   // in deviations
    double weight = 0.0;  // 0: nothing to compare
    double deviation = 1.0;
  };

  [[nodiscard]] double deviation(double range) const {
    return std::hypot(params_.deviation, params_.per_metre * range);
  }

  [[nodiscard]] Comparison compare(const PlacedEcho& echo, const Pose2& pose, int rays) const {
    const auto expected =
        map_.expect(pose * echo.robot_from_sonar, params_.half_cone * kDegree, rays, params_.max_range + 1.0);
    if (!expected) return {};
    const double sigma = deviation(expected->range);
    const double weight = expected->slant < params_.oblique * kDegree ? 1.0 : 0.2;
    return {(echo.range - expected->range) / sigma, weight, sigma};
  }

  /// Geman-McClure: quadratic near zero, bounded by half of robustness squared.
  [[nodiscard]] double loss(double error) const {
    const double c2 = params_.robustness * params_.robustness;
    return 0.5 * c2 * error * error / (c2 + error * error);
  }
  [[nodiscard]] double influence(double error) const {
    const double c2 = params_.robustness * params_.robustness;
    const double share = c2 / (c2 + error * error);
    return share * share;
  }

  /// Minus the log of the posterior.
  [[nodiscard]] double cost(const Pose2& pose, int rays) const {
    double sum = 0.0;
    for (const PlacedEcho& echo : echoes_) {
      const Comparison comparison = compare(echo, pose, rays);
      // An echo where the map has nothing is as unexplained as one far off.
      sum += comparison.weight > 0.0 ? comparison.weight * loss(comparison.error) + (1.0 - comparison.weight) * worst()
                                     : worst();
    }
    return sum / params_.dependence + 0.5 * squared_length(information_, difference(pose, prior_));
  }
  [[nodiscard]] double worst() const { return 0.5 * params_.robustness * params_.robustness; }

  /// The best places of a lattice that spans two deviations of the prior, each a local minimum.
  [[nodiscard]] std::vector<Pose2> basins() const {
    const double step = std::clamp(std::sqrt(std::max(covariance_[0], covariance_[4])), 0.04, 0.2);
    const double turn = std::clamp(std::sqrt(covariance_[8]), 0.01, 0.06);
    struct Candidate {
      double cost;
      Pose2 pose;
    };
    std::vector<Candidate> candidates;
    for (int ix = -kSteps; ix <= kSteps; ++ix) {
      for (int iy = -kSteps; iy <= kSteps; ++iy) {
        for (int it = -kSteps; it <= kSteps; ++it) {
          const Pose2 pose{prior_.x + step * ix, prior_.y + step * iy, prior_.theta + Angle::radians(turn * it)};
          if (squared_length(information_, difference(pose, prior_)) > params_.gate * params_.gate) continue;
          candidates.push_back({cost(pose, kCoarseRays), pose});
        }
      }
    }
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    std::vector<Pose2> result{prior_};
    for (const Candidate& candidate : candidates) {
      if (result.size() > kBasins) break;
      const bool is_new = std::none_of(result.begin() + 1, result.end(), [&](const Pose2& other) {
        const auto d = difference(candidate.pose, other);
        return std::hypot(d[0], d[1]) < 1.5 * step && std::abs(d[2]) < 1.5 * turn;
      });
      if (is_new || result.size() == 1) result.push_back(candidate.pose);
    }
    return result;
  }

  struct Normal {
    PoseMatrix information{};
    std::array<double, 3> gradient{};
  };

  /// Gauss-Newton terms of the echoes alone.
  [[nodiscard]] Normal linearise(const Pose2& pose) const {
    constexpr double kShift = 0.02;  // [m]
    constexpr double kTurn = 0.01;   // [rad]
    Normal normal;
    for (const PlacedEcho& echo : echoes_) {
      const Comparison here = compare(echo, pose, kRays);
      if (here.weight == 0.0 || std::abs(here.error) > 2.0 * params_.robustness) continue;
      std::array<double, 3> slope{};
      bool is_smooth = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto moved = [&](double sign) {
          return Pose2{pose.x + (i == 0 ? sign * kShift : 0.0), pose.y + (i == 1 ? sign * kShift : 0.0),
                       pose.theta + Angle::radians(i == 2 ? sign * kTurn : 0.0)};
        };
        const Comparison before = compare(echo, moved(-1.0), kRays);
        const Comparison after = compare(echo, moved(1.0), kRays);
        if (before.weight == 0.0 || after.weight == 0.0) is_smooth = false;
        const double change = after.error * after.deviation - before.error * before.deviation;
        if (i < 2 && std::abs(change) > 4.0 * kShift) is_smooth = false;  // another surface came into the cone
        slope[i] = change / (2.0 * (i < 2 ? kShift : kTurn) * here.deviation);
      }
      if (!is_smooth) continue;
      const double weight = here.weight * influence(here.error) / params_.dependence;
      for (std::size_t i = 0; i < 3; ++i) {
        normal.gradient[i] += weight * slope[i] * here.error;
        for (std::size_t k = 0; k < 3; ++k) normal.information[3 * i + k] += weight * slope[i] * slope[k];
      }
    }
    return normal;
  }

  [[nodiscard]] Pose2 refine(Pose2 pose) const {
    double now = cost(pose, kRays);
    double damping = 1.0;
    for (int i = 0; i < kIterations; ++i) {
      Normal normal = linearise(pose);
      const auto off = difference(pose, prior_);
      for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t k = 0; k < 3; ++k) {
          normal.gradient[r] += information_[3 * r + k] * off[k];
          normal.information[3 * r + k] += information_[3 * r + k];
        }
      }
      const PoseMatrix inverse = inverse_of(normal.information);
      std::array<double, 3> step{};
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t k = 0; k < 3; ++k) step[r] -= damping * inverse[3 * r + k] * normal.gradient[k];
      const Pose2 next{pose.x + step[0], pose.y + step[1], pose.theta + Angle::radians(step[2])};
      const double then = cost(next, kRays);
      if (then > now) {
        damping *= 0.4;
        continue;
      }
      pose = next;
      now = then;
      if (std::hypot(step[0], step[1]) < 0.002 && std::abs(step[2]) < 0.0005) break;
    }
    return pose;
  }

  void judge(const Pose2& pose, SweepMatch& match) const {
    match.map_from_robot = pose;
    int good = 0;
    for (const PlacedEcho& echo : echoes_) {
      const Comparison comparison = compare(echo, pose, kRays);
      if (comparison.weight < 1.0) continue;
      ++match.comparable;
      if (std::abs(comparison.error) < params_.robustness) ++good;
    }
    match.inliers = match.comparable > 0 ? static_cast<double>(good) / match.comparable : 0.0;
    if (match.comparable < params_.echoes) return;
    if (match.inliers < params_.inliers) {
      match.outcome = MatchOutcome::unlike_the_map;
      return;
    }
    if (squared_length(information_, difference(pose, prior_)) > params_.gate * params_.gate) {
      match.outcome = MatchOutcome::too_far_off;
      return;
    }
    match.outcome = MatchOutcome::matched;
    match.covariance = posterior(linearise(pose).information);
  }

  /// (prior^-1 + I')^-1, where I' is what the echoes say, but never better than the map: I' = (I^-1 + floor)^-1.
  [[nodiscard]] PoseMatrix posterior(const PoseMatrix& of_echoes) const {
    const double position = params_.least_deviation * params_.least_deviation;
    const double heading = params_.least_turn * kDegree * params_.least_turn * kDegree;
    const std::array<double, 3> floor{position, position, heading};
    // (I^-1 + F)^-1 = F^-1 - F^-1 (I + F^-1)^-1 F^-1, also where the echoes say nothing of a direction.
    PoseMatrix sum = of_echoes;
    for (std::size_t i = 0; i < 3; ++i) sum[4 * i] += 1.0 / floor[i];
    const PoseMatrix inner = inverse_of(sum);
    PoseMatrix information = information_;
    for (std::size_t i = 0; i < 3; ++i) {
      information[4 * i] += 1.0 / floor[i];
      for (std::size_t k = 0; k < 3; ++k) information[3 * i + k] -= inner[3 * i + k] / (floor[i] * floor[k]);
    }
    return inverse_of(information);
  }

  const SweepMatchParams& params_;
  const EchoMap& map_;
  const std::vector<PlacedEcho>& echoes_;
  Pose2 prior_;
  PoseMatrix covariance_;
  PoseMatrix information_;
};

}  // namespace

Result<void> SweepMatchParams::validate() const {
  if (!(half_cone > 0.0 && half_cone < 45.0)) return fail("match.half_cone must be > 0 and < 45");
  if (!(max_range > 0.0)) return fail("match.max_range must be > 0");
  if (!(deviation > 0.0)) return fail("match.deviation must be > 0");
  if (!(per_metre >= 0.0)) return fail("match.per_metre must be >= 0");
  if (!(robustness > 0.0)) return fail("match.robustness must be > 0");
  if (!(oblique > 0.0)) return fail("match.oblique must be > 0");
  if (!(dependence >= 1.0)) return fail("match.dependence must be >= 1");
  if (!(least_deviation > 0.0)) return fail("match.least_deviation must be > 0");
  if (!(least_turn > 0.0)) return fail("match.least_turn must be > 0");
  if (!(inliers >= 0.0 && inliers <= 1.0)) return fail("match.inliers must be 0..1");
  if (!(echoes >= 3)) return fail("match.echoes must be >= 3");
  if (!(gate > 0.0)) return fail("match.gate must be > 0");
  if (!(distinct >= 0.0)) return fail("match.distinct must be >= 0");
  return {};
}

SweepMatch match_sweep(const SweepMatchParams& params, const EchoMap& map, const std::vector<PlacedEcho>& echoes,
                       const Pose2& prior, const PoseMatrix& prior_covariance) {
  return Matcher{params, map, echoes, prior, prior_covariance}.run();
}

}  // namespace docent::localization
