#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "docent/base/result.h"

namespace docent::interaction {

/// How many people there are, roughly: baselines and statistics are kept for each.
enum class CrowdClass { quiet, busy, packed };
constexpr auto words_of(CrowdClass) { return std::array{"quiet", "busy", "packed"}; }
inline constexpr int kCrowdClasses = 3;

struct CrowdClassParams {
  double busy_from = 0.04;     ///< [1/m2] > 0 persons: between a quiet museum (0.02) and a busy one (0.08)
  double packed_from = 0.125;  ///< [1/m2] > busy_from: between a busy one and a packed one (0.2)
  template <class V>
  void visit(V& v) {
    v("busy_from", busy_from);
    v("packed_from", packed_from);
  }
  [[nodiscard]] Result<void> validate() const {
    if (!(busy_from > 0.0 && busy_from < packed_from)) return fail("crowd.busy_from must be > 0 and < packed_from");
    return {};
  }
};

/// @param density [1/m2] persons
[[nodiscard]] inline CrowdClass crowd_class(double density, const CrowdClassParams& params) {
  if (density < params.busy_from) return CrowdClass::quiet;
  return density < params.packed_from ? CrowdClass::busy : CrowdClass::packed;
}

/// Mean and spread of numbers that come one by one (Welford's recurrence).
class RunningMoments {
 public:
  void add(double value) {
    ++count_;
    const double step = value - mean_;
    mean_ += step / count_;
    squares_ += step * (value - mean_);
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] double mean() const { return mean_; }
  /// Standard deviation of the population that they are a sample of; 0 of fewer than two.
  [[nodiscard]] double deviation() const {
    return count_ < 2 ? 0.0 : std::sqrt(std::max(squares_, 0.0) / (count_ - 1));
  }
  /// By how many standard deviations a value lies above the mean; 0 while there is no spread.
  [[nodiscard]] double standardised(double value) const {
    const double scale = deviation();
    return scale > 0.0 ? (value - mean_) / scale : 0.0;
  }

 private:
  int count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;
};

/// The same for each class of crowds.
using MomentsByCrowd = std::array<RunningMoments, kCrowdClasses>;

}  // namespace docent::interaction
