#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "docent/sensor_models/proximity_model.h"

namespace docent {

/// What a beam costs at each expected range: how far ln P(d | o), tempered, stays below its best, in steps of
/// 1 / kCostPerNat. Whole numbers, so that every instruction set gives the same belief, bit for bit.
struct BeamCosts {
  std::array<std::uint8_t, kExpectedRanges> costs{};  ///< each <= kMaxCost, so that two add up in a byte
  std::size_t direction = 0;                          ///< 0..headings-1
};
inline constexpr int kMaxCost = 127;
inline constexpr double kCostPerNat = 32.0;

/// Adds, for `count` headings from `first_heading` on, the costs of all beams in one place:
/// sums[i] = sum over beams of costs[row[first_heading + i + direction]]. `row` is a RangeTable's; it may be read up to
/// RangeTable::kReadAhead bytes past its end of use, `sums` be written up to the next multiple of 64.
/// @pre beams.size() * kMaxCost < 65536
using ScoreKernel = void (*)(const std::uint8_t* row, std::size_t first_heading, std::size_t count,
                             std::span<const BeamCosts> beams, std::uint16_t* sums);

/// The kernels this processor can run, the plain one first, the fastest last. They agree bit for bit.
struct NamedScoreKernel {
  std::string name;
  ScoreKernel kernel;
};
[[nodiscard]] std::vector<NamedScoreKernel> score_kernels();

}  // namespace docent
