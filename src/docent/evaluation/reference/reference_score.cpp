#include "docent/evaluation/reference/reference_score.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/base/check.h"

namespace docent::evaluation {
namespace {

constexpr double kLostDistance = 0.5;  ///< [m]
constexpr double kLostHeading = 20.0;  ///< [deg]

double quantile(const std::vector<double>& sorted, double q) {
  return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

ReferenceScore score_against(const ScanReference& reference, std::span<const LocalizedScan> scans,
                             bool start_is_known) {
  DOCENT_CHECK(reference.size() == scans.size());
  ReferenceScore score;
  std::vector<double> errors;
  while (!start_is_known && score.waited < scans.size() && !scans[score.waited].localized) ++score.waited;
  for (std::size_t i = score.waited; i < scans.size(); ++i) {
    if (!reference[i]) continue;
    ++score.scans;
    score.unsure += scans[i].localized ? 0 : 1;
    bool is_lost = true;
    if (scans[i].map_from_base) {
      const double off = distance(scans[i].map_from_base->position(), reference[i]->position());
      const double turned = std::abs((scans[i].map_from_base->theta - reference[i]->theta).degrees());
      is_lost = off > kLostDistance || turned > kLostHeading;
      errors.push_back(off);
      score.mean_m += off;
      score.mean_deg += turned;
      score.max_deg = std::max(score.max_deg, turned);
    }
    score.lost += is_lost ? 1 : 0;
    score.sure_and_wrong += is_lost && scans[i].localized ? 1 : 0;
  }
  if (errors.empty()) return score;
  std::sort(errors.begin(), errors.end());
  score.mean_m /= static_cast<double>(errors.size());
  score.mean_deg /= static_cast<double>(errors.size());
  score.median_m = quantile(errors, 0.5);
  score.p95_m = quantile(errors, 0.95);
  score.max_m = errors.back();
  return score;
}

}  // namespace docent::evaluation
