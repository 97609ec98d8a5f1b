#pragma once

#include <cstdint>
#include <vector>

namespace docent {

/// Quantiles of any number of values in constant memory: counts in bins that grow by a fixed ratio, so that a quantile
/// is known to one part in a hundred, as DDSketch has it [https://arxiv.org/abs/1908.10693].
class Quantiles {
 public:
  static constexpr double kRelativeError = 0.01;
  static constexpr double kLeast = 1e-9;  ///< smaller values count as 0
  static constexpr double kMost = 1e9;    ///< larger ones as this

  /// @pre not NaN
  void add(double value);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// The value below which `share` in [0, 1] of all values lie; 0 for none. Off by at most kRelativeError of itself.
  [[nodiscard]] double at(double share) const;

 private:
  std::vector<std::uint64_t> bins_;  ///< [0] of zeros; grows up to the bin of kMost
  std::uint64_t count_ = 0;
};

}  // namespace docent
