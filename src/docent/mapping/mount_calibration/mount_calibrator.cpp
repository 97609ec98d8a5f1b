#include "docent/mapping/mount_calibration/mount_calibrator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

namespace docent::mapping {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::size_t kNewest = 12;      // pairs that may tell that a mount was knocked
constexpr double kStrange = 6.0;         // mean squared sigmas of them, where some 3 are usual
constexpr std::size_t kNewestDelay = 8;  // pairs that may tell that stamps are late by another time
constexpr double kStrangeDelay = 4.5;    // mean squared sigmas of them
constexpr double kOrdinaryPair = 9.0;    // squared sigmas; who meets another one looks again at once
constexpr std::size_t kAnd = 5;          // characters
constexpr std::size_t kFitEvery = 3;     // pairs, of what is settled;
constexpr std::size_t kFewNew = 36;      // pairs that are fitted, for each new one that is waited for besides: it tells
                                         // little beside them
constexpr double kMuchBetter = 0.6;      // of that, with another mount
constexpr double kHysteresis = 0.6;      // of what is named: below it nothing is corrected any more,
constexpr double kTakenBack = 1.0;       // of it: if the standard deviation is that small, too
constexpr double kKnownEnough = 1.0;     // of the limit from which on robot.yaml is contradicted: a standard deviation
constexpr double kHardlyKnown = 2.0;     // likewise, however large the error seems
constexpr double kMostContradict = 6.0;  // mean squared sigmas: half of the pairs contradict the estimate
constexpr double kBeyondDoubt = 8.0;     // standard deviations
constexpr double kVisitorsAbout = 7.5;   // mean squared sigmas: most of what it sees walks along, but what many pairs
                                         // have beyond doubt is so all the same
constexpr double kElsewhere = 4.0;       // standard deviations
constexpr double kDelaysErr = 1.5;       // of a delay's stated error: a few turns among people err alike
constexpr double kStaysKnown = 1.5;      // of the errors up to which a mount counts as known

std::string text(const char* format, double a, double b = 0.0, double c = 0.0) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, a, b, c);
  return buffer;
}

/// Half of `limit` is passed beyond doubt, and the limit itself by all appearance.
bool is_beyond(double value, double sigma, double limit, double sigmas) {
  return std::abs(value) >= limit && std::abs(value) - sigmas * sigma >= 0.5 * limit;
}

/// A mount is not where it was, whatever both estimates may be off.
bool is_elsewhere(const MountEstimate& now, const MountEstimate& before) {
  const auto is_beyond_doubt = [&](MountUnknown unknown, double moved) {
    return std::abs(moved) > kElsewhere * std::hypot(now.sigma(unknown), before.sigma(unknown));
  };
  const Pose2& a = now.state.base_from_sensor;
  const Pose2& b = before.state.base_from_sensor;
  return is_beyond_doubt(kMountHeading, (a.theta - b.theta).radians()) || is_beyond_doubt(kMountX, a.x - b.x) ||
         is_beyond_doubt(kMountY, a.y - b.y);
}

/// Worth to be told, after what was told last.
bool is_news(const MountEstimate& now, const MountEstimate& told) {
  constexpr double kTurn = 0.3 * kDegree;
  constexpr double kPlace = 0.01;  // [m]
  constexpr double kDelay = 0.01;  // [s]
  constexpr double kSurer = 0.6;   // of the standard deviation
  const Pose2& a = now.state.base_from_sensor;
  const Pose2& b = told.state.base_from_sensor;
  return std::abs((a.theta - b.theta).radians()) > kTurn || distance(a.position(), b.position()) > kPlace ||
         std::abs(now.state.delay - told.state.delay) > kDelay ||
         now.sigma(kMountHeading) < kSurer * told.sigma(kMountHeading) ||
         now.sigma_position() < kSurer * told.sigma_position();
}

/// Puts it into words.
void say(CalibratedScanner& scanner, const Contradictions& what, const NominalScanner& nominal) {
  const MountEstimate& now = scanner.estimate;
  if (scanner.named == what && !is_news(now, scanner.told)) return;
  scanner.named = what;
  scanner.told = now;
  scanner.finding.clear();
  const Pose2& found = now.state.base_from_sensor;
  if (what.is_turned)
    scanner.finding +=
        text(" and turned by %+.1f ± %.1f degrees", (found.theta - nominal.base_from_sensor.theta).degrees(),
             now.sigma(kMountHeading) / kDegree);
  if (what.is_displaced)
    scanner.finding +=
        text(" and displaced by x %+.0f y %+.0f ± %.0f cm", 100.0 * (found.x - nominal.base_from_sensor.x),
             100.0 * (found.y - nominal.base_from_sensor.y), std::max(1.0, 100.0 * now.sigma_position()));
  if (what.is_late)
    scanner.finding += text(" and its stamps %+.0f ± %.0f ms late", 1000.0 * now.state.delay,
                            std::max(1.0, 1000.0 * now.sigma(kMountDelay)));
  if (!scanner.finding.empty()) scanner.finding = "scanner " + nominal.name + ": " + scanner.finding.substr(kAnd);
}

/// What to do about a scanner that sees the room turn the wrong way.
std::string mirrored(const NominalScanner& scanner) {
  return "scanner " + scanner.name + ": mirrors left and right: " +
         (scanner.is_upside_down ? "its driver turns the sweeps over by itself? write upside_down: false"
                                 : "it hangs upside down? write upside_down: true") +
         " in body.scanners (or the odometry turns the wrong way)";
}

}  // namespace

MountCalibrator::MountCalibrator(const MountCalibratorParams& params, std::vector<NominalScanner> scanners)
    : params_{params}, nominal_{std::move(scanners)}, is_released_{nominal_.empty()} {
  for (const NominalScanner& scanner : nominal_) {
    followers_.push_back({ScanFollower{params.follower}, {}, {}, vague_prior(scanner.base_from_sensor, params.fit), 0});
    CalibratedScanner result;
    result.estimate.state.base_from_sensor = scanner.base_from_sensor;
    result.estimate.covariance = followers_.back().prior.sigma.cwiseAbs2().asDiagonal();
    results_.push_back(std::move(result));
    judge(results_.size() - 1);
  }
}

void MountCalibrator::move(Time stamp, const Pose2& odom_from_base) {
  const auto reading = unbroken_.add(stamp, odom_from_base);
  if (reading.is_late) return;
  if (reading.is_set_back) odometry_.forget();
  if (reading.jumped || reading.is_set_back)
    for (Follower& follower : followers_) {
      follower.sweeps.forget();
      follower.turning.forget();
    }
  if (!odometry_.empty()) {
    const Pose2 moved = inverse(odometry_.latest()) * reading.odom_from_base;
    way_ += norm(moved.position());
    for (Follower& follower : followers_) {
      follower.rest_way -= norm(moved.position());
      follower.rest_turn -= std::abs(moved.theta.radians());
    }
  }
  odometry_.add(stamp, reading.odom_from_base);
}

void MountCalibrator::see(std::size_t scanner, Time stamp, const sensor_models::LaserReading& reading) {
  if (!rests(followers_[scanner])) followers_[scanner].sweeps.keep(stamp, reading);
  followers_[scanner].turning.keep(stamp, reading);
}

void MountCalibrator::rest(Follower& follower) const {
  follower.sweeps.forget();
  follower.rest_way = params_.rest_way;
  follower.rest_turn = params_.rest_turn * kDegree;
}

void MountCalibrator::remember(std::size_t scanner, const MountEstimate& estimate, std::size_t pairs) {
  Follower& follower = followers_[scanner];
  follower.prior.state = estimate.state;
  for (int i = 0; i < kMountUnknowns; ++i) follower.prior.sigma[i] = std::sqrt(estimate.covariance(i, i));
  follower.remembered = pairs;
  fit(scanner);
}

bool MountCalibrator::work() {
  bool is_new = false;
  for (std::size_t i = 0; i < followers_.size(); ++i) {
    Follower& follower = followers_[i];
    const auto side_before = follower.turning.side();
    follower.turning.follow(odometry_);
    is_new = is_new || follower.turning.side() != side_before;
    const double way = results_[i].is_known ? params_.follower.way : params_.follower.first_way;
    // A guess by a mount that is not known makes pairs that bear it out.
    const Pose2& mount =
        results_[i].is_known ? results_[i].estimate.state.base_from_sensor : results_[i].base_from_sensor;
    const auto pairs = follower.sweeps.follow(odometry_, mount, way);
    for (const MotionPair& pair : pairs) follower.pairs.push_back(pair);
    while (follower.pairs.size() > static_cast<std::size_t>(params_.pairs)) follower.pairs.pop_front();
    if (pairs.empty()) continue;
    follower.unfitted += pairs.size();
    const MountState& state = results_[i].estimate.state;
    const bool rests = results_[i].is_settled && std::all_of(pairs.begin(), pairs.end(), [&](const MotionPair& pair) {
                         return residual_of(pair, state, params_.fit) <= kOrdinaryPair;
                       });
    if (rests) rest(follower);
    if (follower.unfitted < std::max(rests ? kFitEvery : 1, 1 + follower.pairs.size() / kFewNew)) continue;
    follower.unfitted = 0;
    fit(i);
    is_new = true;
  }
  return is_new;
}

bool MountCalibrator::forget_old(Follower& follower, const MountEstimate& before) const {
  if (follower.pairs.size() + follower.remembered < 2 * kNewest || follower.pairs.size() < kNewest) return false;
  double strange = 0.0;
  for (std::size_t i = follower.pairs.size() - kNewest; i < follower.pairs.size(); ++i)
    strange += std::min(9.0, residual_of(follower.pairs[i], before.state, params_.fit));
  if (strange < kStrange * static_cast<double>(kNewest)) return false;
  const std::vector<MotionPair> newest(follower.pairs.end() - static_cast<std::ptrdiff_t>(kNewest),
                                       follower.pairs.end());
  const MountPrior vague = vague_prior(before.state.base_from_sensor, params_.fit);
  const MountEstimate now = fit_mount(newest, vague, params_.fit);
  if (now.misfit > kMuchBetter * strange / static_cast<double>(kNewest)) return false;
  // Wheels that slip on carpet are strange all day: another mount it is only if that is elsewhere beyond doubt.
  if (!is_elsewhere(now, before)) return false;
  // Somebody has knocked against it, or the robot was mended.
  follower.pairs.erase(follower.pairs.begin(), follower.pairs.end() - static_cast<std::ptrdiff_t>(kNewest));
  follower.remembered = 0;
  return true;
}

void MountCalibrator::forget_delay(Follower& follower, const MountEstimate& estimate) const {
  if (follower.pairs.size() + follower.remembered < 2 * kNewestDelay || follower.pairs.size() < kNewestDelay) return;
  const auto older = follower.pairs.end() - static_cast<std::ptrdiff_t>(kNewestDelay);
  const std::vector<MotionPair> newest(older, follower.pairs.end());
  double strange = 0.0;
  for (const MotionPair& pair : newest) strange += std::min(9.0, residual_of(pair, estimate.state, params_.fit));
  strange /= static_cast<double>(kNewestDelay);
  if (strange < kStrangeDelay) return;
  MountPrior prior{.state = estimate.state, .sigma = estimate.covariance.diagonal().cwiseSqrt()};
  prior.sigma[kMountDelay] = params_.fit.delay_prior;
  const MountEstimate now = fit_mount(newest, prior, params_.fit);
  const double apart = std::abs(now.state.delay - estimate.state.delay);
  if (now.misfit > kMuchBetter * strange ||
      !is_beyond(apart, now.sigma(kMountDelay), 0.5 * params_.named_delay, params_.sigmas))
    return;
  prior.state.delay = now.state.delay;
  follower.prior = prior;
  follower.remembered += follower.pairs.size() - kNewestDelay;
  follower.pairs.erase(follower.pairs.begin(), older);
}

void MountCalibrator::fit(std::size_t scanner) {
  Follower& follower = followers_[scanner];
  forget_delay(follower, results_[scanner].estimate);
  if (forget_old(follower, results_[scanner].estimate)) {
    follower.prior = vague_prior(nominal_[scanner].base_from_sensor, params_.fit);
    is_released_ = false;
  }
  const std::vector<MotionPair> pairs(follower.pairs.begin(), follower.pairs.end());
  results_[scanner].estimate = fit_mount(pairs, follower.prior, params_.fit);
  results_[scanner].pairs = pairs.size() + follower.remembered;
  judge(scanner);
}

bool is_named(const Deviation& off, std::size_t pairs, double misfit, const MountCalibratorParams& params) {
  if (pairs < static_cast<std::size_t>(params.fewest_pairs)) return false;
  const bool is_beyond_doubt = std::abs(off.value) > kBeyondDoubt * off.sigma;
  const bool has_many = misfit <= kVisitorsAbout && pairs >= static_cast<std::size_t>(params.fit.few_pairs);
  const bool has_consent = misfit <= kMostContradict || (is_beyond_doubt && has_many);
  // Nothing is said of what is hardly known.
  const bool is_known_enough =
      off.sigma <= kKnownEnough * off.limit || (is_beyond_doubt && off.sigma <= kHardlyKnown * off.limit);
  return has_consent && is_known_enough && is_beyond(off.value, off.sigma, off.limit, params.sigmas);
}

void MountCalibrator::judge(std::size_t scanner) {
  CalibratedScanner& result = results_[scanner];
  const MountEstimate& estimate = result.estimate;
  const Pose2& nominal = nominal_[scanner].base_from_sensor;
  const double heading = (estimate.state.base_from_sensor.theta - nominal.theta).radians();
  const double x = estimate.state.base_from_sensor.x - nominal.x;
  const double y = estimate.state.base_from_sensor.y - nominal.y;
  const bool has_pairs = result.pairs >= static_cast<std::size_t>(params_.fewest_pairs);
  // What was named and is used stays so while the next corridor contradicts it: only who knows well that there is
  // hardly anything takes it back.
  const auto contradicts = [&](double value, double sigma, double limit, bool is_so) {
    if (is_so) return std::abs(value) >= kHysteresis * limit || sigma > kTakenBack * limit;
    return is_named({value, sigma, limit}, result.pairs, estimate.misfit, params_);
  };
  const Contradictions what{
      contradicts(heading, estimate.sigma(kMountHeading), params_.named_heading * kDegree, result.named.is_turned),
      contradicts(std::hypot(x, y), estimate.sigma_position(), params_.named_position, result.named.is_displaced),
      contradicts(estimate.state.delay, kDelaysErr * estimate.sigma(kMountDelay), params_.named_delay,
                  result.named.is_late)};
  say(result, what, nominal_[scanner]);
  result.base_from_sensor = nominal;
  result.delay = 0.0;
  if (params_.corrects && what.is_turned) result.base_from_sensor.theta = estimate.state.base_from_sensor.theta;
  if (params_.corrects && what.is_displaced) {
    result.base_from_sensor.x = estimate.state.base_from_sensor.x;
    result.base_from_sensor.y = estimate.state.base_from_sensor.y;
  }
  if (params_.corrects && what.is_late) result.delay = estimate.state.delay;
  // A robot that speeds up and slows down with each corridor that contradicts another one is no use to anybody.
  const double known = result.is_known ? kStaysKnown : 1.0;
  result.is_known = has_pairs && estimate.sigma(kMountHeading) <= known * params_.known_heading * kDegree &&
                    estimate.sigma_position() <= known * params_.known_position;
  result.is_settled = result.is_known && estimate.sigma(kMountHeading) <= params_.settled_heading * kDegree &&
                      estimate.sigma_position() <= params_.settled_position;
  result.is_borne_out = is_borne_out(result);
  is_released_ = is_released_ || std::all_of(results_.begin(), results_.end(),
                                             [](const auto& one) { return one.is_known || one.is_borne_out; });
  // What two or three pairs say of their own errors is worth nothing.
  result.doubt_heading = params_.doubt_heading * kDegree;
  result.doubt_position = params_.doubt_position;
  if (!has_pairs) return;
  result.doubt_heading = std::min(result.doubt_heading, estimate.sigma(kMountHeading));
  result.doubt_position = std::min(result.doubt_position, estimate.sigma_position());
}

/// Where visitors walk along a mount is known well only after a long way. Whoever has seen it from many pairs, hardly
/// worse than that, and by no more elsewhere than chance may have it, drives on as the others do.
bool MountCalibrator::is_borne_out(const CalibratedScanner& scanner) const {
  constexpr double kHardly = 2.0;  // of the errors up to which a mount counts as known
  const double heading = scanner.estimate.sigma(kMountHeading);
  const double position = scanner.estimate.sigma_position();
  const Pose2 off = inverse(scanner.base_from_sensor) * scanner.estimate.state.base_from_sensor;
  return way_ >= params_.borne_out_way && scanner.pairs >= static_cast<std::size_t>(params_.borne_out_pairs) &&
         heading <= kHardly * params_.known_heading * kDegree && position <= kHardly * params_.known_position &&
         std::abs(off.theta.radians()) <= std::max(heading, params_.named_heading * kDegree) &&
         norm(off.position()) <= std::max(position, params_.named_position);
}

CalibratedBase MountCalibrator::base() const {
  CalibratedBase base;
  double way = 0.0;
  double turn = 0.0;
  double way_weight = 0.0;
  double turn_weight = 0.0;
  bool has_pairs = false;
  for (const CalibratedScanner& scanner : results_) {
    const double w = 1.0 / scanner.estimate.covariance(kWayScale, kWayScale);
    const double t = 1.0 / scanner.estimate.covariance(kTurnScale, kTurnScale);
    way += w * scanner.estimate.state.way_scale;
    turn += t * scanner.estimate.state.turn_scale;
    way_weight += w;
    turn_weight += t;
    has_pairs = has_pairs || scanner.pairs >= static_cast<std::size_t>(params_.fewest_pairs);
  }
  if (results_.empty()) return base;
  base.way_scale = way / way_weight;
  base.turn_scale = turn / turn_weight;
  base.way_sigma = 1.0 / std::sqrt(way_weight);
  base.turn_sigma = 1.0 / std::sqrt(turn_weight);
  if (has_pairs && is_beyond(base.way_scale - 1.0, base.way_sigma, params_.named_scale, params_.sigmas))
    base.finding += text(" and each metre of odometry is %.3f ± %.3f m", base.way_scale, base.way_sigma);
  if (has_pairs && is_beyond(base.turn_scale - 1.0, base.turn_sigma, params_.named_scale, params_.sigmas))
    base.finding += text(" and each degree that it turns is %.3f ± %.3f", base.turn_scale, base.turn_sigma);
  if (!base.finding.empty()) base.finding = "base: " + base.finding.substr(kAnd);
  return base;
}

bool MountCalibrator::is_known() const {
  return !is_mirrored() &&
         std::all_of(results_.begin(), results_.end(), [](const auto& scanner) { return scanner.is_known; });
}

bool MountCalibrator::is_mirrored() const {
  return std::any_of(followers_.begin(), followers_.end(),
                     [](const Follower& follower) { return follower.turning.side() == TurningSide::Side::mirrored; });
}

std::string MountCalibrator::finding() const {
  std::string all;
  const auto add = [&all](const std::string& finding) {
    if (!finding.empty()) all += (all.empty() ? "" : "; ") + finding;
  };
  for (std::size_t i = 0; i < results_.size(); ++i)
    add(followers_[i].turning.side() == TurningSide::Side::mirrored ? mirrored(nominal_[i]) : results_[i].finding);
  add(base().finding);
  return all;
}

}  // namespace docent::mapping
