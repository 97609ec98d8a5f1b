#include "docent/vision/ceiling/evidence/ceiling_evidence.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr int kAnywhere = 256;                    // poses that tell the mean cost
constexpr float kPlainVariance = 2.5e-5F;         // [square of brightness] of what is plain: (1 / 200)^2
constexpr double kClosest = 1.0 - 1e-6;           // correlation beyond which a logarithm says no more
constexpr double kFewest = 0.25, kMost = 1000.0;  // independent samples that can be learned
constexpr int kSections = 60;

/// Halton's sequence: spread evenly, and the same always.
double spread(int index, int base) {
  double value = 0.0, share = 1.0;
  for (int i = index; i > 0; i /= base) share /= base, value += share * (i % base);
  return value;
}

CeilingSamplesParams samples_of(const CeilingEvidenceParams& params) {
  return {.block = params.block, .steepest = params.steepest, .most = params.samples / 2, .flat_step = 2};
}

double log_of(double correlation) { return std::log1p(-std::min(correlation * correlation, kClosest)); }

}  // namespace

Result<void> CeilingEvidenceParams::validate() const {
  if (!(samples > 1 && samples <= 10000)) return fail("ceiling_evidence.samples must be 2 .. 10000");
  if (!(block >= 1 && block <= 64)) return fail("ceiling_evidence.block must be 1 .. 64");
  if (!(steepest > 0.0 && blur > 0.0)) return fail("ceiling_evidence.steepest and blur must be > 0");
  if (!(independent > 0.0 && most_nats > 0.0)) return fail("ceiling_evidence.independent and most_nats must be > 0");
  if (!(best_correlation > 0.0 && best_correlation < 1.0))
    return fail("ceiling_evidence.best_correlation must be above 0 and below 1");
  if (!(least_contrast > 0.0)) return fail("ceiling_evidence.least_contrast must be > 0");
  if (!(least_share >= 0.0 && least_share <= 1.0)) return fail("ceiling_evidence.least_share must be 0 .. 1");
  if (!(oldest > 0.0 && motion >= 0.0 && turn >= 0.0))
    return fail("ceiling_evidence.oldest must be > 0, motion and turn >= 0");
  return {};
}

CeilingEvidence::CeilingEvidence(const CeilingMosaic& mosaic, const CeilingCamera& camera,
                                 const CeilingEvidenceParams& params)
    : params_{params}, level_{mosaic, params.blur}, sampler_{camera, samples_of(params)} {
  DOCENT_CHECK(params.validate());
  const GridFrame& frame = level_.frame();
  for (int i = 1; i <= kAnywhere; ++i)
    anywhere_.push_back({frame.origin.x + spread(i, 2) * frame.columns * frame.resolution,
                         frame.origin.y + spread(i, 3) * frame.rows * frame.resolution,
                         Angle::degrees(360.0 * spread(i, 5))});
}

void CeilingEvidence::see(const GrayPicture& picture, Time time, const Pose2& odom_from_robot) {
  seen_.reset();
  const std::span<const CeilingSample> all = sampler_.take(picture);
  if (sampler_.contrast() < params_.least_contrast) return;
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(params_.samples));
  if (count < 2) return;
  places_.clear();
  brightness_.clear();
  const CameraMount& mount = sampler_.camera().mount;
  const double per_metre = 1.0 / level_.frame().resolution;
  for (std::size_t i = 0; i < count; ++i) {
    const CeilingSample& sample = all[i * all.size() / count];
    brightness_.push_back(sample.brightness);
    for (const double height : level_.heights()) {
      const double above = height - mount.position.z();
      places_.push_back(
          {static_cast<float>(per_metre * (mount.position.x() + above * static_cast<double>(sample.slope_x))),
           static_cast<float>(per_metre * (mount.position.y() + above * static_cast<double>(sample.slope_y)))});
    }
  }
  seen_ = time;
  odom_at_picture_ = odom_from_robot;
}

bool CeilingEvidence::observe(const localization::ObservationMoment& moment) {
  if (!seen_ || std::abs(to_seconds(moment.time - *seen_)) > params_.oldest) return false;
  if (odom_at_last_) {
    const Pose2 moved = inverse(*odom_at_last_) * odom_at_picture_;
    if (norm(moved.position()) < params_.motion && std::abs(moved.theta.degrees()) < params_.turn) return false;
  }
  robot_then_from_now_ = {};
  double sum = 0.0;
  int judged = 0;
  for (const Pose2& pose : anywhere_) {
    const auto found = correlation(pose);
    if (!found) continue;
    sum += cost(*found);
    ++judged;
  }
  if (judged == 0) return false;
  mean_cost_ = sum / judged;
  robot_then_from_now_ = inverse(moment.odom_from_robot) * odom_at_picture_;
  odom_at_last_ = odom_at_picture_;
  seen_.reset();
  return true;
}

std::optional<double> CeilingEvidence::correlation(const Pose2& map_from_robot) const {
  const auto c = static_cast<float>(std::cos(map_from_robot.theta.radians()));
  const auto s = static_cast<float>(std::sin(map_from_robot.theta.radians()));
  const GridFrame& frame = level_.frame();
  const auto x = static_cast<float>((map_from_robot.x - frame.origin.x) / frame.resolution);
  const auto y = static_cast<float>((map_from_robot.y - frame.origin.y) / frame.resolution);
  float n = 0.0F, pictures = 0.0F, mosaics = 0.0F, pictures2 = 0.0F, mosaics2 = 0.0F, both = 0.0F;
  const std::size_t parts = level_.heights().size();
  const Place* place = places_.data();
  for (const float shown : brightness_) {
    float expected = 0.0F;
    bool found = false;
    for (std::size_t part = 0; part < parts; ++part, ++place)
      found = found || level_.nearest(x + c * place->x - s * place->y, y + s * place->x + c * place->y, part, expected);
    if (!found) continue;
    n += 1.0F, pictures += shown, mosaics += expected;
    pictures2 += shown * shown, mosaics2 += expected * expected, both += shown * expected;
  }
  if (n < 2.0F || static_cast<double>(n) < params_.least_share * static_cast<double>(brightness_.size()))
    return std::nullopt;
  const float in_picture = pictures2 / n - pictures / n * (pictures / n),
              in_mosaic = mosaics2 / n - mosaics / n * (mosaics / n);
  const float together = both / n - pictures / n * (mosaics / n);
  if (in_picture < kPlainVariance || in_mosaic < kPlainVariance || together <= 0.0F) return 0.0;
  return std::min(1.0, static_cast<double>(together / std::sqrt(in_picture * in_mosaic)));
}

double CeilingEvidence::cost(double correlation) const {
  const double worse = log_of(std::max(0.0, correlation)) - log_of(params_.best_correlation);
  return std::clamp(0.5 * params_.independent * worse, 0.0, params_.most_nats);
}

void CeilingEvidence::add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const {
  for (std::size_t i = 0; i < nats.size(); ++i) {
    const auto found = correlation(map_from_robot[i] * robot_then_from_now_);
    nats[i] += static_cast<float>(found ? cost(*found) : mean_cost_);
  }
}

double learn_independent(std::span<const EvidenceTrial> trials) {
  // ln P(truth) = -n/2 ln(1 - r^2) - ln of the sum of all: concave in n, so sections of ln n find its greatest sum.
  const auto fitness = [&](double ln_n) {
    const double half = 0.5 * std::exp(ln_n);
    double sum = 0.0;
    for (const EvidenceTrial& trial : trials) {
      double most = 0.0;
      for (const double r : trial.correlations) most = std::max(most, -half * log_of(std::max(0.0, r)));
      double all = 0.0;
      for (const double r : trial.correlations) all += std::exp(-half * log_of(std::max(0.0, r)) - most);
      sum += -half * log_of(std::max(0.0, trial.correlations[trial.truth])) - most - std::log(all);
    }
    return sum;
  };
  double low = std::log(kFewest), high = std::log(kMost);
  for (int i = 0; i < kSections; ++i) {
    const double third = (high - low) / 3.0;
    if (fitness(low + third) < fitness(high - third)) {
      low += third;
    } else {
      high -= third;
    }
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace docent::vision
