#include "docent/interaction/attract/style_evidence.h"

#include <algorithm>
#include <cmath>

#include "docent/base/check.h"

namespace docent::interaction {
namespace {

constexpr std::array kClaims{StyleClaim::friendly_attracts_more, StyleClaim::friendly_attracts_fewer};
constexpr std::size_t kMostLeans = 20;

/// ln of exp(l x g) / E[exp(l x g)] over the styles that could have been drawn.
double log_factor(double lean_times_reward, const AttractionTrial& trial) {
  double expected = 0.0;
  for (int style = 0; style < kStyles; ++style)
    expected += trial.chances.at(static_cast<std::size_t>(style)) *
                std::exp(lean_times_reward * friendliness_of(static_cast<Style>(style)));
  return lean_times_reward * friendliness_of(style_of(trial.action)) - std::log(expected);
}

/// ln of the mean of exp(values).
double log_mean(const std::vector<double>& values) {
  const double most = *std::max_element(values.begin(), values.end());
  double sum = 0.0;
  for (const double value : values) sum += std::exp(value - most);
  return most + std::log(sum / static_cast<double>(values.size()));
}

}  // namespace

Result<void> StyleEvidenceParams::validate() const {
  if (!(level > 0.0 && level < 1.0)) return fail("evidence.level must be > 0 and < 1");
  if (!(settled >= 2)) return fail("evidence.settled must be >= 2");
  if (!(clip > 0.0 && clip <= 100.0)) return fail("evidence.clip must be > 0 and <= 100");
  const auto is_bad = [](double lean) { return !(lean > 0.0 && lean <= 5.0); };
  if (leans.empty() || leans.size() > kMostLeans || std::any_of(leans.begin(), leans.end(), is_bad))
    return fail("evidence.leans must be some numbers > 0 and <= 5");
  return {};
}

StyleEvidence::StyleEvidence(const StyleEvidenceParams& params, const CrowdClassParams& crowds)
    : params_{params}, crowds_{crowds} {
  log_products_.fill(std::vector<double>(params_.leans.size(), 0.0));
}

void StyleEvidence::add(const AttractionTrial& trial) {
  ++trials_;
  RunningMoments& rewards = rewards_.at(static_cast<std::size_t>(crowd_class(trial.density, crowds_)));
  const bool is_settled = rewards.count() >= params_.settled;
  const double reward = is_settled ? std::clamp(rewards.standardised(trial.reward), -params_.clip, params_.clip) : 0.0;
  rewards.add(trial.reward);
  for (std::size_t side = 0; side < kClaims.size(); ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    auto& products = log_products_.at(side);
    for (std::size_t i = 0; i < products.size(); ++i)
      products[i] += log_factor(sign * params_.leans[i] * reward, trial);
    const bool is_proved = log_mean(products) >= std::log(2.0 / params_.level);
    if (!is_proved || claim_ == kClaims.at(side)) continue;
    claim_ = kClaims.at(side);
    claimed_after_ = trials_;
  }
}

double StyleEvidence::log_evidence(StyleClaim claim) const {
  DOCENT_CHECK(claim != StyleClaim::none);
  return log_mean(log_products_.at(claim == StyleClaim::friendly_attracts_more ? 0 : 1));
}

}  // namespace docent::interaction
