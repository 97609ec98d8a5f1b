#include "docent/localization/judgement/verdict.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace docent::localization {

namespace {

/// Weights of the logistic function behind P(lost), one set for a robot that has said "here" and one for a robot that
/// has not; >= 0 but for the bias. Learned from recordings by `scripts/evaluate localization --part calibrate`.
struct DoubtWeights {
  double bias;
  double mass;  ///< of ln(m / (1 - m)), m: the mass outside the best mode
  double youth;
  double contradiction;
  double surprise;
  double hidden;
  double unmapped;  ///< of the walls that the map lacks, the less the more it explains besides
  double spread;
};
constexpr DoubtWeights kWhenSure{-2.305, 0.775, 0.000, 7.979, 7.725, 8.585, 28.282, 0.266};
constexpr DoubtWeights kWhenNot{-6.594, 0.200, 0.000, 0.000, 10.029, 14.982, 9.282, 22.097};
/// Of the odds that tracks leave to other places. They count less evidence than the belief and were too timid by two to
/// three times, in simulation and in recorded buildings.
constexpr double kOddsOfOthers = 0.4;
constexpr double kLostWhereBlind = 0.05;  ///< P(lost) at least, of a robot that sees nothing
/// P(lost) at least, of a place that somebody told and that the first looks did not bear out: in recorded logs such a
/// place was wrong far more often than right, however well it fits.
constexpr double kLostWhereTold = 0.5;

}  // namespace

Evidence with_best_mode(Evidence evidence, const BeliefSummary& summary, const std::optional<Pose2>& predicted) {
  if (summary.modes.empty()) return evidence;
  const BeliefMode& best = summary.modes.front();
  evidence.mass = best.mass;
  evidence.spread = std::sqrt(std::max(0.0, best.covariance[0] + best.covariance[4]));
  if (predicted) {
    const double off = distance(predicted->position(), best.map_from_robot.position());
    const double turned = std::abs((predicted->theta - best.map_from_robot.theta).degrees());
    // Odometry errs in proportion: after a long way the mode may come out farther from where it was foreseen.
    const double turn = evidence.turn * 180.0 / std::numbers::pi;
    evidence.is_same_mode = off < std::max(0.5, 0.3 * evidence.way) && turned < std::max(15.0, 0.3 * turn);
  }
  return evidence;
}

Result<void> VerdictParams::validate() const {
  if (!(enough_share > 0.5 && enough_share < 1.0)) return fail("verdict.enough_share must be 0.5..1");
  if (!(enough_mass > 0.5 && enough_mass < 1.0)) return fail("verdict.enough_mass must be 0.5..1");
  if (!(too_little_mass >= 0.0 && too_little_mass < enough_mass))
    return fail("verdict.too_little_mass must be below enough_mass");
  if (!(here > 0.0 && here <= no_longer_here && no_longer_here <= given_up && given_up <= 1.0))
    return fail("verdict.here, no_longer_here and given_up must be 0..1, none above the next");
  if (!(widest_spread > 0.0)) return fail("verdict.widest_spread must be > 0");
  if (!(confirmations >= 0.0 && travelled >= 0.0 && turned >= 0.0))
    return fail("verdict.confirmations, travelled and turned must be >= 0");
  if (!(blind_way > 0.0)) return fail("verdict.blind_way must be > 0");
  if (!(least_agreement >= 0.0 && least_agreement < 1.0)) return fail("verdict.least_agreement must be 0..1");
  if (!(most_contradiction > 0.0 && most_contradiction <= 1.0)) return fail("verdict.most_contradiction must be 0..1");
  if (!(startled_through > 0.0 && startled_hidden > 0.0))
    return fail("verdict.startled_through and startled_hidden must be > 0");
  return {};
}

void Verdict::reset() { *this = Verdict{params_}; }

void Verdict::assume_localized() {
  reset();
  confirmed_ = params_.confirmations;
  way_ = params_.travelled;
  keeps_its_place_ = is_told_ = true;
}

void Verdict::uproot() {
  localized_ = keeps_its_place_ = has_said_ = has_found_ = is_told_ = false;
  unsure_ = hopeless_ = 0;
  confirmed_ = way_ = turn_ = 0.0;
  witness_.reset();
}

void Verdict::add(const Evidence& evidence) {
  const Agreement& readings = evidence.readings;
  constexpr double kMemory = 0.25;        // an update's share in the running means
  constexpr double kFewReadings = 8.0;    // fewer tell nothing
  constexpr double kMostOfOneScan = 1.0;  // [m]: three scans, however far apart, are no reason to give up a place
  const double share = kMemory * evidence.weight;
  const double all = readings.agrees + readings.shorter + readings.longer;
  const double through = readings.agrees + readings.longer;
  if (all >= kFewReadings) agreement_ += share * (readings.agrees / all - agreement_);
  if (through >= kFewReadings) {
    contradiction_ += share * (readings.longer / through - contradiction_);
  }

  constexpr double kTooLittleShare = 0.5;  // another place is the likelier
  const bool is_good = evidence.mass >= params_.enough_mass && evidence.share >= params_.enough_share &&
                       evidence.spread <= params_.widest_spread;
  if (!evidence.is_same_mode || (!is_good && !has_said_)) {
    confirmed_ = way_ = turn_ = 0.0;
  } else {
    confirmed_ += evidence.weight * evidence.views;
    way_ += evidence.way;
    turn_ += evidence.turn;
  }
  const bool borne_out = agreement_ >= params_.least_agreement && contradiction_ <= params_.most_contradiction;
  // Readings that are too short are people; those that pass through walls mean that the place is wrong.
  const bool sees_nothing = agreement_ < 0.4 * params_.least_agreement;
  witness_ = evidence.witness;
  blind_ = sees_nothing && !is_witnessed() ? blind_ + evidence.way : 0.0;
  const bool contradicted = this->contradicted();
  if (!contradicted) bad_ = 0.0;
  if (contradicted && (through >= kFewReadings || hopelessly_blind()))
    bad_ += std::min(evidence.way + 0.5 * evidence.turn, kMostOfOneScan);

  mass_ = evidence.mass;
  share_ = evidence.share;
  spread_ = evidence.spread;

  const bool is_borne_on = evidence.is_same_mode && evidence.mass >= params_.too_little_mass &&
                           evidence.share >= kTooLittleShare && !contradicted && blind_ <= params_.blind_way;
  const bool stays = has_said_ && is_borne_on;
  const bool is_found = (is_good && borne_out && moved() >= 1.0 && seen() >= 1.0) || (is_borne_on && is_witnessed());
  has_found_ = has_found_ ? is_borne_on : is_found && p_lost(true) <= params_.given_up;
  localized_ = localized_ ? stays && lasting_doubt() <= params_.no_longer_here
                          : (stays || is_found) && p_lost(true) <= params_.here;
  if (!localized_ && contradicted) confirmed_ = way_ = turn_ = 0.0;
  keeps_its_place_ =
      localized_ || (keeps_its_place_ && evidence.is_same_mode && !contradicted && evidence.share >= kTooLittleShare);
  has_said_ = localized_ || (has_said_ && keeps_its_place_);
  is_told_ = is_told_ && !localized_;
}

void Verdict::look(const Glance& glance) {
  constexpr double kMemory = 0.1;
  glance_ = glance;
  // In the middle of a hall hardly a wall is within reach: as many as are needed now, one fewer then, and nobody came.
  hidden_ = glance.tells() ? std::max(0.0, glance.shorter - shorter_) : 0.0;
  if (glance.tells()) shorter_ += kMemory * (glance.shorter - shorter_);
  unmapped_ += kMemory * (glance.unmapped - unmapped_);

  constexpr int kPatience = 8;          // glances: somebody who steps before the robot is a doubt for less
  const bool was_judged = mass_ > 0.0;  // not yet where the place was given
  const double doubt = keeps_its_place_ && was_judged ? p_lost(true) : 0.0;
  unsure_ = doubt > params_.no_longer_here ? unsure_ + 1 : 0;
  hopeless_ = doubt > params_.given_up ? hopeless_ + 1 : 0;
  if (unsure_ >= kPatience) localized_ = false;
  if (hopeless_ >= kPatience) uproot();
}

double Verdict::p_lost() const {
  const double lost = p_lost(has_said_);
  return has_said_ || is_witnessed() ? lost
                                     : std::max(lost, is_told_ ? std::max(kLostWhereTold, params_.here) : params_.here);
}

double Verdict::lasting_doubt() const {
  Verdict calm = *this;
  calm.glance_.through = calm.hidden_ = 0.0;
  return calm.p_lost(true);
}

double Verdict::p_lost(bool has_said) const {
  if (mass_ <= 0.0) return 1.0;
  const double left = std::clamp(1.0 - mass_, 1e-4, 1.0 - 1e-4);
  const DoubtWeights& w = has_said ? kWhenSure : kWhenNot;
  const double strangeness = 1.0 - agreement_;
  const double z = w.bias + w.mass * std::log(left / (1.0 - left)) + w.youth * (1.0 - confirmation()) +
                   w.contradiction * contradiction_ + w.surprise * glance_.through + w.hidden * hidden_ +
                   w.unmapped * unmapped_ * strangeness * strangeness + w.spread * std::min(spread_, 1.0);
  const double right = 1.0 / (1.0 + std::exp(z));
  const double others = kOddsOfOthers * (1.0 - share_);
  const double best_of_all = share_ / std::max(share_ + others, 1e-9);
  return with_witness(std::max(1.0 - right * best_of_all, kLostWhereBlind * blindness(has_said)));
}

bool Verdict::is_witnessed() const {
  constexpr double kTrusted = 0.01;  // P(wrong) of a witness that is enough
  return witness_ && *witness_ <= kTrusted;
}

double Verdict::with_witness(double lost) const {
  constexpr double kLeastOfBoth = 0.002;  // what both sensors err by together: the map, the frame of the mosaic
  constexpr double kContradicted = 0.2;   // P(lost) at least where the witness has the robot elsewhere
  if (!witness_) return lost;
  if (*witness_ > 1.0) return std::max(lost, kContradicted);
  const double odds = lost / std::max(1e-9, 1.0 - lost) * (*witness_ / std::max(1e-9, 1.0 - *witness_));
  return std::min(lost, std::max(kLeastOfBoth, odds / (1.0 + odds)));
}

double Verdict::blindness(bool has_said) const {
  constexpr double kHidden = 0.75, kCovered = 0.85;  // of a glance's readings end before the wall
  const double behind_people = (shorter_ - kHidden) / (kCovered - kHidden);
  // Of the readings, that the map explains. A robot that has not found its place yet may have taken people for walls.
  const auto [sees, blind] = has_said ? std::pair{0.15, 0.05} : std::pair{0.55, 0.35};
  return std::clamp(std::max(behind_people, (sees - agreement_) / (sees - blind)), 0.0, 1.0);
}

double Verdict::moved() const {
  return std::min(1.0, std::max(way_ / std::max(params_.travelled, 1e-9),
                                turn_ * 180.0 / std::numbers::pi / std::max(params_.turned, 1e-9)));
}

double Verdict::seen() const { return std::min(1.0, confirmed_ / std::max(params_.confirmations, 1e-9)); }

double Verdict::confirmation() const { return 0.5 * (moved() + seen()); }

bool Verdict::contradicted() const { return contradiction_ > 2.0 * params_.most_contradiction || hopelessly_blind(); }

bool Verdict::hopelessly_blind() const { return blind_ > 3.0 * params_.blind_way; }

bool Verdict::collapsed() const {
  constexpr double kPatience = 6.0;  // [m]: furniture that has moved contradicts the map too, over some metres
  return bad_ >= kPatience;
}

}  // namespace docent::localization
