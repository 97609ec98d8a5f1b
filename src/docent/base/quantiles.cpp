#include "docent/base/quantiles.h"

#include <algorithm>
#include <cmath>

namespace docent {

namespace {

/// A bin holds values from b to b * kRatio; its middle, 2 b kRatio / (1 + kRatio), is off by kRelativeError at either
/// end.
constexpr double kRatio = (1.0 + Quantiles::kRelativeError) / (1.0 - Quantiles::kRelativeError);

}  // namespace

void Quantiles::add(double value) {
  ++count_;
  std::size_t bin = 0;
  if (value >= kLeast) bin = 1 + static_cast<std::size_t>(std::log(std::min(value, kMost) / kLeast) / std::log(kRatio));
  if (bin >= bins_.size()) bins_.resize(bin + 1);
  ++bins_[bin];
}

double Quantiles::at(double share) const {
  if (count_ == 0) return 0.0;
  const auto rank = static_cast<std::uint64_t>(share * static_cast<double>(count_ - 1));
  std::size_t bin = 0;
  for (std::uint64_t below = bins_[0]; below <= rank; below += bins_[bin]) ++bin;
  if (bin == 0) return 0.0;
  return kLeast * std::pow(kRatio, static_cast<double>(bin - 1)) * 2.0 * kRatio / (1.0 + kRatio);
}

}  // namespace docent
