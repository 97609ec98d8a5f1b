#include "docent/vision/ceiling/localizer/ceiling_localizer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "docent/base/check.h"

namespace docent::vision {
namespace {

constexpr double kSamePlace = 0.35;    // [m]
constexpr double kSameTurn = 12.0;     // [deg]
constexpr double kBest = 0.95;         // correlation that the right pose reaches; better ones cost nothing less
constexpr double kHopeless = 12.0;     // [nat] behind the best: a way that is followed no longer
constexpr double kWorthFitting = 6.0;  // [nat] likewise, that is fitted between views
constexpr double kNews = 0.05, kNewsTurn = 3.0;  // [m], [deg] that make another picture
constexpr int kSameAgain = 10;                   // pictures of one place, then one is looked at
constexpr double kClosestFit = 1.0 - 1e-6;

bool is_same(const Pose2& a, const Pose2& b) {
  return distance(a.position(), b.position()) < kSamePlace && std::abs((a.theta - b.theta).degrees()) < kSameTurn;
}

double log_left(double correlation) { return std::log1p(-std::min(correlation * correlation, kClosestFit)); }

CeilingSamplesParams samples_for(const CeilingLocalizerParams& params) {
  return {.block = 6, .steepest = params.steepest, .most = params.samples, .flat_step = 4};
}

/// Every so many, so that `most` are left.
std::vector<CeilingSample> few_of(std::span<const CeilingSample> all, int most) {
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(most));
  std::vector<CeilingSample> few;
  few.reserve(count);
  for (std::size_t i = 0; i < count; ++i) few.push_back(all[i * all.size() / count]);
  return few;
}

}  // namespace

Result<void> CeilingLocalizerParams::validate() const {
  if (!(samples > 1 && few > 1)) return fail("ceiling.samples and few must be > 1");
  if (!(steepest > 0.0)) return fail("ceiling.steepest must be > 0");
  if (!(search_step > 0.05 && search_turn > 0.5)) return fail("ceiling.search_step must be > 0.05, search_turn > 0.5");
  if (!(most_found > 0 && most_fitted > 0 && most_ways > 1))
    return fail("ceiling.most_found and most_fitted must be > 0, most_ways > 1");
  if (!(views > 0 && views <= 100 && fewest > 0 && fewest <= views))
    return fail("ceiling.views must be 1..100, fewest 1..views");
  if (!(spacing > 0.0 && turned > 0.0)) return fail("ceiling.spacing and turned must be > 0");
  if (!(independent > 0.0 && most_nats > 0.0)) return fail("ceiling.independent and most_nats must be > 0");
  if (!(good > 0.0 && good < 1.0 && good_width > 0.0)) return fail("ceiling.good must be 0..1, good_width > 0");
  if (!(sure > 0.0 && sure < 1.0)) return fail("ceiling.sure must be 0..1");
  if (!(search_rarely > 0 && give_up > 0)) return fail("ceiling.search_rarely and give_up must be > 0");
  if (!(least_contrast > 0.0)) return fail("ceiling.least_contrast must be > 0");
  return {};
}

CeilingLocalizer::CeilingLocalizer(const CeilingMosaic& mosaic, const CeilingCamera& camera,
                                   const CeilingLocalizerParams& params)
    : params_{params},
      levels_{pyramid_of(mosaic, {params.search_step, 0.12, 0.05})},
      sampler_{camera, samples_for(params)},
      search_{mosaic, levels_.front(), camera.mount, params.search_step, params.search_turn} {
  DOCENT_CHECK(params_.validate());
  constexpr double kLeastShare = 0.5;  // of the samples: what little of a picture lies on the mosaic fits anywhere
  fit_params_.coarse_stride = 1;
  fit_params_.least_share = kLeastShare;
}

double CeilingLocalizer::Way::nats() const { return std::accumulate(costs.begin(), costs.end(), 0.0); }

void CeilingLocalizer::forget() {
  views_.clear();
  ways_.clear();
  odom_.reset();
  last_.reset();
  since_search_ = unexplained_ = 0;
}

double CeilingLocalizer::nats(double correlation) const {
  const double worse = log_left(std::max(0.0, correlation)) - log_left(kBest);
  return std::clamp(0.5 * params_.independent * worse, 0.0, params_.most_nats);
}

CeilingLocalizer::Fitted CeilingLocalizer::fitted(const Pose2& near, std::span<const CeilingSample> samples) const {
  const auto fit = fit_pose(near, levels_, sampler_.camera().mount, samples, fit_params_);
  // Another place is another way.
  if (!fit || !is_same(fit->map_from_robot, near)) return {PoseFit{.map_from_robot = near}, 0.0, params_.most_nats};
  return {*fit, fit->correlation, nats(fit->correlation)};
}

bool CeilingLocalizer::is_new_view(const Pose2& odom_from_robot) const {
  if (views_.empty()) return true;
  const Pose2 moved = inverse(views_.back().odom_from_robot) * odom_from_robot;
  return norm(moved.position()) >= params_.spacing || std::abs(moved.theta.degrees()) >= params_.turned;
}

std::optional<CeilingLocalizer::Fix> CeilingLocalizer::see(const GrayPicture& picture, const Pose2& odom_from_robot) {
  const Pose2 moved = odom_ ? inverse(*odom_) * odom_from_robot : Pose2{};
  const bool is_news = !odom_ || norm(moved.position()) > kNews || std::abs(moved.theta.degrees()) > kNewsTurn;
  if (!is_news && ++same_ < kSameAgain) return last_;
  same_ = 0;
  last_ = look(picture, odom_from_robot, moved);
  return last_;
}

std::optional<CeilingLocalizer::Fix> CeilingLocalizer::look(const GrayPicture& picture, const Pose2& odom_from_robot,
                                                            const Pose2& moved) {
  const std::span<const CeilingSample> samples = sampler_.take(picture);
  odom_ = odom_from_robot;
  constexpr std::size_t kFewestSamples = 24;
  if (sampler_.contrast() < params_.least_contrast || samples.size() < kFewestSamples) {
    for (Way& way : ways_) way.pose = way.pose * moved;
    return std::nullopt;
  }
  const bool is_view = is_new_view(odom_from_robot);
  if (is_view) {
    views_.push_back({{samples.begin(), samples.end()}, odom_from_robot, {}});
    is_searched_ = false;
    if (static_cast<int>(views_.size()) > params_.views) views_.pop_front();
  }
  follow(samples, moved, is_view);
  ++since_search_;
  const bool is_due = p_wrong() >= params_.sure || since_search_ >= params_.search_rarely;
  if (is_due && !is_searched_) search(samples, odom_from_robot);
  if (is_view) {
    const bool explains = !ways_.empty() && ways_.front().correlations.back() > 0.5 * params_.good;
    unexplained_ = explains ? 0 : unexplained_ + 1;
    if (unexplained_ >= params_.give_up) {
      forget();
      odom_ = odom_from_robot;
    }
  }
  if (ways_.empty() || !ways_.front().fits) return std::nullopt;
  const Way& best = ways_.front();
  // Neighbouring samples, the mosaic and the lens err together.
  const double together = static_cast<double>(std::max(1, best.fit.samples)) / params_.independent;
  constexpr double kLeast = 1e-4, kLeastTurn = 2.5e-5;  // [m2], [rad2]
  Fix fix{best.pose, together * best.fit.covariance, p_wrong(), best.fit.correlation};
  fix.covariance.diagonal() += Eigen::Vector3d{kLeast, kLeast, kLeastTurn};
  return fix;
}

void CeilingLocalizer::follow(std::span<const CeilingSample> samples, const Pose2& moved, bool is_view) {
  const double least = ways_.empty() ? 0.0 : ways_.front().nats();
  for (Way& way : ways_) {
    if (!is_view && way.nats() > least + kWorthFitting) {
      way.pose = way.pose * moved;
      continue;
    }
    const Fitted found = fitted(way.pose * moved, samples);
    way.fits = found.correlation > 0.0;
    way.pose = found.fit.map_from_robot;
    way.fit = found.fit;
    if (is_view) {
      way.costs.push_back(found.nats);
      way.correlations.push_back(found.correlation);
    }
    while (way.costs.size() > views_.size()) way.costs.pop_front(), way.correlations.pop_front();
  }
  prune();
}

/// The places and headings at which the pictures of the last views are likeliest together.
std::vector<Pose2> CeilingLocalizer::searched(const Pose2& odom_from_robot) {
  std::vector<CeilingSearch::View> seen;
  for (View& view : views_) {
    if (view.likelihoods.empty()) view.likelihoods = search_.likelihoods(few_of(view.samples, params_.few));
    seen.push_back({&view.likelihoods, inverse(odom_from_robot) * view.odom_from_robot});
  }
  return search_.best(seen, static_cast<std::size_t>(params_.most_found));
}

void CeilingLocalizer::search(std::span<const CeilingSample> samples, const Pose2& odom_from_robot) {
  since_search_ = 0;
  is_searched_ = true;
  const std::vector<CeilingSample> few = few_of(samples, params_.few);
  // The places that a few samples fit best, then those that all fit.
  std::vector<PoseFit> fits;
  for (const Pose2& start : searched(odom_from_robot))
    if (const auto fit = fit_pose(start, levels_, sampler_.camera().mount, few, fit_params_)) fits.push_back(*fit);
  std::stable_sort(fits.begin(), fits.end(),
                   [](const PoseFit& a, const PoseFit& b) { return a.correlation > b.correlation; });
  if (static_cast<int>(fits.size()) > params_.most_fitted) fits.resize(static_cast<std::size_t>(params_.most_fitted));
  for (const PoseFit& rough : fits) {
    const auto fit = fit_pose(rough.map_from_robot, levels_, sampler_.camera().mount, samples, fit_params_);
    if (fit && fit->correlation > 0.5 * params_.good) take_in(*fit, odom_from_robot);
  }
  prune();
}

void CeilingLocalizer::take_in(const PoseFit& found, const Pose2& odom_from_robot) {
  const bool is_known =
      std::any_of(ways_.begin(), ways_.end(), [&](const Way& way) { return is_same(way.pose, found.map_from_robot); });
  if (is_known || distance(found.map_from_robot.position(), {}) > 1e6) return;
  Way way{found.map_from_robot, {}, {}, found, true};
  // Back through the views; the last may be of another picture than this one.
  Pose2 pose = found.map_from_robot;
  Pose2 odom = odom_from_robot;
  const double most = (ways_.empty() ? params_.most_nats * params_.views : ways_.front().nats()) + kHopeless;
  double sum = 0.0;
  for (std::size_t k = views_.size(); k-- > 0;) {
    const View& view = views_[k];
    const Fitted then = fitted(pose * (inverse(odom) * view.odom_from_robot), view.samples);
    pose = then.fit.map_from_robot;
    odom = view.odom_from_robot;
    way.costs.push_front(then.nats);
    way.correlations.push_front(then.correlation);
    sum += then.nats;
    if (sum > most) return;
  }
  ways_.push_back(std::move(way));
}

void CeilingLocalizer::prune() {
  std::stable_sort(ways_.begin(), ways_.end(), [](const Way& a, const Way& b) { return a.nats() < b.nats(); });
  std::vector<Way> kept;
  const double least = ways_.empty() ? 0.0 : ways_.front().nats();
  for (Way& way : ways_) {
    if (static_cast<int>(kept.size()) >= params_.most_ways || way.nats() > least + kHopeless) break;
    const bool has_met =
        std::any_of(kept.begin(), kept.end(), [&](const Way& other) { return is_same(other.pose, way.pose); });
    if (!has_met) kept.push_back(std::move(way));
  }
  ways_ = std::move(kept);
}

double CeilingLocalizer::p_wrong() const {
  if (ways_.empty() || static_cast<int>(views_.size()) < params_.fewest) return 1.0;
  const double least = ways_.front().nats();
  double sum = 0.0;
  for (const Way& way : ways_) sum += std::exp(least - way.nats());
  const auto& seen = ways_.front().correlations;
  const double mean = std::accumulate(seen.begin(), seen.end(), 0.0) / static_cast<double>(seen.size());
  const double looks_like_it = 1.0 / (1.0 + std::exp(-(mean - params_.good) / params_.good_width));
  return 1.0 - looks_like_it / sum;
}

}  // namespace docent::vision
