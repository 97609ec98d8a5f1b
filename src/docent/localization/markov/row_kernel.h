#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "docent/base/instruction_set.h"

namespace docent::localization {

/// What walks over a belief walks over rows: one place, its headings in blocks of sixteen floats. What lies in the last
/// block beyond the headings is 0. Sums are made in sixteen lanes and reduced in one order, whatever the instruction
/// set, so all sets agree bit for bit.
inline constexpr std::size_t kRowBlock = 16;

/// Lines of cells that are mixed along y together: they share most of what they read.
inline constexpr std::size_t kRowGroup = 4;

/// Rows are not normalised when they are written, for the sum is known only afterwards. A probability is
/// row[h] * scale + bias[h], and it is active above limit[h].
struct RowScale {
  float scale = 1.0F;
  std::span<const float> bias;   ///< [blocks * 16], 0 beyond the headings
  std::span<const float> limit;  ///< [blocks * 16], infinite beyond the headings
  [[nodiscard]] float probability(const float* row, std::size_t heading) const {
    return row[heading] * scale + bias[heading];
  }
};

/// A convolution along one axis whose weights depend on the heading: for each block of headings the offsets at which
/// any of them has a weight.
struct AxisTaps {
  int reach = 0;                     ///< largest |offset| [cells]
  std::vector<std::uint32_t> begin;  ///< [blocks + 1] into offsets
  std::vector<int> offsets;          ///< [cells] from the source to the target
  std::vector<float> weights;        ///< [offsets][16]
};

/// A symmetric blur along the headings, which go round: single weights about the middle, then weights that four
/// headings share, so that a long tail costs a quarter.
struct HeadingBlur {
  std::vector<float> middle;  ///< odd length
  std::vector<float>
      fours;  ///< of the headings half + 1 + 4 i … half + 4 + 4 i on both sides, half = middle.size() / 2
  [[nodiscard]] std::size_t half() const { return middle.size() / 2; }
  [[nodiscard]] std::size_t reach() const { return half() + 4 * fours.size(); }  ///< [headings]
};

struct RowTotals {
  double mass = 0.0;
  float peak = 0.0F;
};

struct RowCensus {
  double inactive_mass = 0.0;
  std::size_t inactive = 0;
};

/// What a row holds.
struct RowContent {
  float peak = 0.0F;         ///< no probability is above it
  float active_mass = 0.0F;  ///< sum over the active states
  std::uint32_t active = 0;  ///< how many
};

/// How a row is multiplied: active states by exp(-min(max(cost - best, 0) * nats_per_cost, most_nats)).
struct RowEvidence {
  std::uint16_t best = 0;
  float nats_per_cost = 0.0F;
  float most_nats = 60.0F;  ///< <= 87
  float sea_factor = 1.0F;  ///< for the inactive ones
};

/// The passes over rows, for one instruction set. All rows are aligned to 64 bytes and whole blocks long.
struct RowKernels {
  /// out = probabilities.
  void (*expand)(const float* row, const RowScale& scale, float* out);
  /// For `count` cells: out[c][h] = sum over taps of weight * line[c + reach - offset][h]; line [count + 2 * reach].
  void (*mix_columns)(const AxisTaps& taps, const float* line, std::size_t count, std::size_t blocks, float* out);
  /// For kRowGroup lines of cells: out[r * out_stride + h] = sum over taps of weight * lines[r + reach - offset][at +
  /// h]; lines [2 * reach + kRowGroup].
  void (*mix_rows)(const AxisTaps& taps, const float* const* lines, std::size_t at, std::size_t blocks, float* out,
                   std::size_t out_stride);
  /// fours[h] = centre[h] + … + centre[h + 3] for h from -halo on, before `blocks` blocks and behind them. Both lie in
  /// buffers with room for the halo, whole blocks, on both sides, and a block more.
  void (*add_fours)(const float* centre, std::size_t halo, std::size_t blocks, float* fours);
  /// out[h] = sum over k of blur's weight of k * centre[h + k], |k| <= reach. `centre` and `fours` as above.
  void (*turn)(const float* centre, const HeadingBlur& blur, const float* fours, std::size_t headings, float* out,
               RowTotals& totals);
  /// A bit for each block with an active state.
  std::uint64_t (*active_blocks)(const float* row, const RowScale& scale);
  std::uint16_t (*least_of_all)(const std::uint16_t* costs, std::size_t headings);
  /// The least cost of an active state; 65535 if there is none.
  std::uint16_t (*least_cost)(const float* row, const RowScale& scale, const std::uint16_t* costs);
  /// [Markov1998] eq. 1 without eta.
  void (*reweigh)(float* row, const RowScale& scale, const std::uint16_t* costs, const RowEvidence& evidence,
                  RowTotals& totals);
  /// Adds what is inactive to the census.
  RowContent (*take_census)(const float* row, const RowScale& scale, std::size_t headings, RowCensus& census);
  /// Makes the row hold its probabilities, and `level` where they are inactive.
  void (*settle)(float* row, const RowScale& scale, float level, std::size_t headings);
  /// Sum of p ln p over active states [nat], within 2e-6 relative, and how many they are.
  double (*sum_p_log_p)(const float* row, const RowScale& scale, std::size_t& active);
};

[[nodiscard]] const RowKernels& row_kernels(InstructionSet set);

}  // namespace docent::localization
