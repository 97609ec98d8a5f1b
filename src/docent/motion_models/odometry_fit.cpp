#include "docent/motion_models/odometry_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace docent::motion_models {

namespace {

using Variances = std::array<double, kNoiseSources>;
constexpr double kLeastLabelPosition = 1e-6;  // [m2]
constexpr double kLeastLabelHeading = 1e-7;   // [rad2]

Variances variances_of(const LabelledMotionNoise& noise) {
  Variances result{};
  result[translation_per_metre] = noise.motion.translation_per_metre;
  result[translation_per_radian] = noise.motion.translation_per_radian;
  result[rotation_per_metre] = noise.motion.rotation_per_metre;
  result[rotation_per_radian] = noise.motion.rotation_per_radian;
  result[label_position] = noise.label_position;
  result[label_heading] = noise.label_heading;
  return result;
}

LabelledMotionNoise noise_of(const Variances& variances, double slip) {
  LabelledMotionNoise noise;
  noise.motion = {variances[translation_per_metre], variances[translation_per_radian], variances[rotation_per_metre],
                  variances[rotation_per_radian], slip};
  noise.label_position = variances[label_position];
  noise.label_heading = variances[label_heading];
  return noise;
}

Symmetric3 covariance(const MotionWindow& window, const Variances& variances) {
  Symmetric3 sum;
  for (std::size_t i = 0; i < kNoiseSources; ++i) sum.add(variances[i], window.unit[i]);
  return sum;
}

double determinant(const Symmetric3& a) {
  return a.xx * (a.yy * a.tt - a.yt * a.yt) - a.xy * (a.xy * a.tt - a.yt * a.xt) + a.xt * (a.xy * a.yt - a.yy * a.xt);
}

Symmetric3 inverted(const Symmetric3& a, double determinant) {
  const double scale = 1.0 / determinant;
  return {scale * (a.yy * a.tt - a.yt * a.yt), scale * (a.xt * a.yt - a.xy * a.tt),
          scale * (a.xy * a.yt - a.xt * a.yy), scale * (a.xx * a.tt - a.xt * a.xt),
          scale * (a.xt * a.xy - a.xx * a.yt), scale * (a.xx * a.yy - a.xy * a.xy)};
}

std::array<double, 3> times(const Symmetric3& a, const std::array<double, 3>& v) {
  return {a.xx * v[0] + a.xy * v[1] + a.xt * v[2], a.xy * v[0] + a.yy * v[1] + a.yt * v[2],
          a.xt * v[0] + a.yt * v[1] + a.tt * v[2]};
}

double inner(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Trace of the product of two symmetric matrices.
double trace(const Symmetric3& a, const Symmetric3& b) {
  return a.xx * b.xx + a.yy * b.yy + a.tt * b.tt + 2.0 * (a.xy * b.xy + a.xt * b.xt + a.yt * b.yt);
}

struct Gaussian {
  Symmetric3 precision;
  double log_density = 0.0;
};
Gaussian gaussian(const Symmetric3& covariance, const std::array<double, 3>& error) {
  const double det = std::max(determinant(covariance), 1e-40);
  const Symmetric3 precision = inverted(covariance, det);
  return {precision,
          -0.5 * (inner(error, times(precision, error)) + std::log(det)) - 1.5 * std::log(2.0 * std::numbers::pi)};
}

/// One window under the noise: both Gaussians, and how likely it slipped before and after looking at the error.
struct Explained {
  Gaussian kept, slipped;
  double slip_share = 0.0;
  double log_likelihood = 0.0;
};
Explained explained(const MotionWindow& window, const Variances& variances, double slip) {
  Explained result;
  Symmetric3 sum = covariance(window, variances);
  result.kept = gaussian(sum, window.error);
  sum.add(1.0, window.slip);
  result.slipped = gaussian(sum, window.error);
  const double log_kept = window.exposure * std::log1p(-slip);
  const double with = std::log(-std::expm1(std::min(log_kept, -1e-300))) + result.slipped.log_density;
  const double without = log_kept + result.kept.log_density;
  const double most = std::max(with, without);
  result.log_likelihood = most + std::log(std::exp(with - most) + std::exp(without - most));
  result.slip_share = std::exp(with - result.log_likelihood);
  return result;
}

double log_likelihood(std::span<const MotionWindow> windows, const Variances& variances, double slip) {
  double sum = 0.0;
  for (const MotionWindow& window : windows) sum += explained(window, variances, slip).log_likelihood;
  return windows.empty() ? 0.0 : sum / static_cast<double>(windows.size());
}

/// ln of the prior [nat], but for a constant; `usual` is its peak.
double slip_prior(const OdometryFitParams& options, double usual, double slip) {
  return options.slip_prior * (usual * std::log(slip) + (1.0 - usual) * std::log1p(-slip));
}

/// The slip probability that makes `shares` of the windows slipped most likely: ternary search, the function is
/// concave.
double best_slip(std::span<const MotionWindow> windows, std::span<const double> shares,
                 const OdometryFitParams& options, double usual) {
  const auto value = [&](double slip) {
    double sum = slip_prior(options, usual, slip);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const double log_kept = windows[i].exposure * std::log1p(-slip);
      sum += (1.0 - shares[i]) * log_kept + shares[i] * std::log(-std::expm1(std::min(log_kept, -1e-300)));
    }
    return sum;
  };
  double low = options.least_slip;
  double high = options.most_slip;
  for (int i = 0; i < 40; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (value(a) < value(b) ? low : high) = value(a) < value(b) ? a : b;
  }
  return 0.5 * (low + high);
}

/// Where a climb stands.
struct Place {
  Variances variances{};
  double slip = 0.0;
  double log_likelihood = 0.0;  ///< [nat] a window, with the priors
};

/// Climbs the likelihood over the variances and the slip probability.
class Climb {
 public:
  Climb(std::span<const MotionWindow> windows, const std::array<bool, kNoiseSources>& fitted, const Variances& floors,
        const OdometryFitParams& options, const Place& usual)
      : windows_{windows}, fitted_{fitted}, floors_{floors}, options_{options}, usual_{usual} {}

  [[nodiscard]] Place at(const Variances& variances, double slip) const {
    double value = log_likelihood(windows_, variances, slip);
    if (!options_.fixed_motion) {
      double prior = slip_prior(options_, usual_.slip, slip);
      for (std::size_t i = 0; i < label_position; ++i)
        if (fitted_[i])
          prior -= options_.variance_prior * (std::log(variances[i]) + usual_.variances[i] / variances[i]);
      value += prior / static_cast<double>(windows_.size());
    }
    return {variances, slip, value};
  }

  /// One step of EM and minorize-maximize; the likelihood does not fall. Its value is not known yet.
  [[nodiscard]] Place step(const Place& from) const {
    Variances found{};
    Variances foreseen{};
    std::vector<double> shares;
    shares.reserve(windows_.size());
    Place next = from;
    for (const MotionWindow& window : windows_) {
      const Explained here = explained(window, from.variances, from.slip);
      shares.push_back(here.slip_share);
      for (const auto& [part, share] :
           {std::pair{&here.kept, 1.0 - here.slip_share}, std::pair{&here.slipped, here.slip_share}}) {
        const auto weighted = times(part->precision, window.error);
        for (std::size_t i = 0; i < kNoiseSources; ++i) {
          found[i] += share * inner(weighted, times(window.unit[i], weighted));
          foreseen[i] += share * trace(part->precision, window.unit[i]);
        }
      }
    }
    for (std::size_t i = 0; i < kNoiseSources; ++i) {
      const double prior = i < label_position ? options_.variance_prior : 0.0;
      const double at = from.variances[i];
      const double rises = 0.5 * found[i] * at * at + prior * usual_.variances[i];
      const double falls = 0.5 * foreseen[i] + prior / at;
      if (fitted_[i] && falls > 0.0) next.variances[i] = std::max(floors_[i], std::sqrt(rises / falls));
    }
    if (!options_.fixed_motion) next.slip = best_slip(windows_, shares, options_, usual_.slip);
    return next;
  }

  /// Two steps and a leap along the way they show (squared extrapolation of the logarithms), taken only where it gets
  /// higher.
  [[nodiscard]] Place round(const Place& from) const {
    const Place once = step(from);
    const Place twice = step(once);
    Place best = at(twice.variances, twice.slip);
    Place leap = best;
    double speed = 0.0;
    double bend = 0.0;
    for (std::size_t i = 0; i < kNoiseSources; ++i) {
      if (!fitted_[i]) continue;
      const double r = std::log(once.variances[i] / from.variances[i]);
      const double v = std::log(twice.variances[i] / once.variances[i]) - r;
      speed += r * r;
      bend += v * v;
    }
    if (bend <= 0.0) return best;
    const double length = std::min(std::sqrt(speed / bend), 30.0);
    if (length <= 1.0) return best;
    for (std::size_t i = 0; i < kNoiseSources; ++i) {
      if (!fitted_[i]) continue;
      const double r = std::log(once.variances[i] / from.variances[i]);
      const double v = std::log(twice.variances[i] / once.variances[i]) - r;
      const double leapt = std::clamp(2.0 * length * r + length * length * v, -3.0, 3.0);
      leap.variances[i] = std::max(floors_[i], from.variances[i] * std::exp(leapt));
    }
    leap = at(leap.variances, leap.slip);
    return leap.log_likelihood > best.log_likelihood ? leap : best;
  }

 private:
  std::span<const MotionWindow> windows_;
  std::array<bool, kNoiseSources> fitted_;
  Variances floors_;
  OdometryFitParams options_;
  Place usual_;  ///< the peak of the prior
};

/// Mean errors a metre of the windows without turns, which a calibration of the wheels would take away.
void find_drift(std::span<const MotionWindow> windows, OdometryFit& fit) {
  double way = 0.0;
  double turned = 0.0;
  double longer = 0.0;
  for (const MotionWindow& window : windows) {
    if (window.turn > 0.3 * window.way || std::abs(window.error[2]) > 0.3) continue;
    way += window.way;
    turned += window.error[2];
    longer += window.error[0];
  }
  if (way <= 0.0) return;
  fit.drift_turn = turned / way;
  fit.drift_length = longer / way;
}

}  // namespace

double mean_log_likelihood(std::span<const MotionWindow> windows, const LabelledMotionNoise& noise) {
  return log_likelihood(windows, variances_of(noise), noise.motion.slip_probability);
}

Result<OdometryFit> fit_odometry_model(std::span<const MotionWindow> windows, const LabelledMotionNoise& start,
                                       const OdometryFitParams& options) {
  OdometryFit fit;
  fit.windows = windows.size();
  for (const MotionWindow& window : windows) {
    fit.way += window.way;
    fit.turn += window.turn;
  }
  if (windows.size() < options.least_windows || fit.way < options.least_way)
    return fail("too little motion with a known place: " + std::to_string(windows.size()) + " windows, " +
                std::to_string(std::lround(fit.way)) + " m");
  const bool turns = fit.turn >= options.least_turn;
  std::array<bool, kNoiseSources> fitted{};
  fitted[label_position] = fitted[label_heading] = true;
  fitted[translation_per_metre] = fitted[rotation_per_metre] = !options.fixed_motion;
  fitted[translation_per_radian] = fitted[rotation_per_radian] = !options.fixed_motion && turns;
  Variances floors{};
  floors[translation_per_metre] = options.least_translation;
  floors[rotation_per_metre] = options.least_rotation;
  floors[rotation_per_radian] = options.least_turn_rotation;
  floors[label_position] = kLeastLabelPosition;
  floors[label_heading] = kLeastLabelHeading;

  Variances variances = variances_of(start);
  for (std::size_t i = 0; i < kNoiseSources; ++i)
    if (fitted[i]) variances[i] = std::max({variances[i], floors[i], 1e-9});  // from 0 no multiple leads away
  double slip = start.motion.slip_probability;
  if (!options.fixed_motion) slip = std::clamp(slip, options.least_slip, options.most_slip);
  const Climb climb{windows, fitted, floors, options, {variances, slip, 0.0}};
  Place place = climb.at(variances, slip);
  fit.history.push_back(place.log_likelihood);
  for (int round = 0; round < options.most_rounds; ++round) {
    place = climb.round(place);
    fit.history.push_back(place.log_likelihood);
    if (fit.history.back() - fit.history[fit.history.size() - 2] < options.settled) break;
  }
  fit.noise = noise_of(place.variances, place.slip);
  fit.after = mean_log_likelihood(windows, fit.noise);
  fit.before = fit.after;
  if (!options.fixed_motion) {
    OdometryFitParams labels_only = options;
    labels_only.fixed_motion = true;
    if (const auto plain = fit_odometry_model(windows, start, labels_only)) fit.before = plain->after;
  }
  find_drift(windows, fit);
  return fit;
}

}  // namespace docent::motion_models
