#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/aligned_vector.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/belief/neighbourhood.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/markov/motion_kernel.h"
#include "docent/localization/markov/row_kernel.h"
#include "docent/localization/markov/score_kernel.h"

namespace docent::localization {

/// How much one scan may count. The beams of a scan err together, where the map is wrong or people stand around, and
/// the scans of a metre err together too: between places far apart, evidence must gather slowly, or the belief is sure
/// of a wrong one. Within the neighbourhood of the pose that the robot is sure of, the same errors only pull a little,
/// and the evidence may be sharp.
struct EvidenceWeights {
  double most_nats = 60.0;  ///< [nat] that a scan counts at most, against the active state that explains it best
  double far_share = 1.0;   ///< 0..1 of the evidence that counts between places
  double far_most_nats = 60.0;
  /// One thing that the map does not know, a person or a door, hides several neighbouring beams: together they cost at
  /// most so much. The beams come in the order of directions.
  double most_sector_nats = 1e3;  ///< [nat]
  std::size_t sectors = 1;        ///< of a turn
  /// The neighbourhood in which all of the evidence counts; everything else, and it as a whole, gets the share alone.
  std::optional<Neighbourhood> focus;
};

/// Adds the costs of other sensors, in steps of 1 / kCostPerNat, to those of all headings of a place.
using PlaceCosts = std::function<void(std::size_t place, std::span<std::uint16_t> costs)>;

/// P(L = l) over all states of a StateSpace, with the selective update of [Markov1998] 3.1.
///
/// States at or below the threshold are not updated; all of them share one value, the sea level. Places with a state
/// above the threshold are kept as rows of headings, ascending by place; all other places are nothing but sea. States
/// of a kept row that are under water hold the sea level themselves, so that a row is a plain array for every loop.
/// When the sea rises over the threshold, every state is above it, and all places are kept again: all wake.
///
/// A pass over the belief costs as much as its arithmetic, so nothing is walked over twice: rows are left without
/// normalisation until the next pass reads them (RowScale), and motion works in place.
class PositionBelief {
 public:
  /// Probabilities of all headings of a place.
  class Row {
   public:
    Row(const float* values, std::size_t size, const RowScale& scale) : values_{values}, size_{size}, scale_{scale} {}
    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] float operator[](std::size_t heading) const { return scale_.probability(values_, heading); }
    struct Iterator {
      const Row* row;
      std::size_t heading;
      float operator*() const { return (*row)[heading]; }
      Iterator& operator++() {
        ++heading;
        return *this;
      }
      bool operator==(const Iterator& other) const { return heading == other.heading; }
    };
    [[nodiscard]] Iterator begin() const { return {this, 0}; }
    [[nodiscard]] Iterator end() const { return {this, size_}; }

   private:
    const float* values_;
    std::size_t size_;
    RowScale scale_;
  };

  /// `threshold_fraction`: the threshold as a share of the a priori probability 1 / states; 0.001 in [Rhino1999] 3.1.5.
  /// With 0 no state ever sinks: the plain, dense algorithm. `space` must outlive the belief.
  /// Memory: 4 bytes a state, 2 more while it is reweighed.
  PositionBelief(const StateSpace& space, double threshold_fraction);

  void make_uniform();
  /// Gaussians; what their masses leave out is uniform, and at least `uniform_mass` is.
  void make_modes(std::span<const BeliefMode> modes, double uniform_mass);

  /// [Markov1998] eq. 2. Mass that would leave the free places is taken out and shared by all. O(kept states * (offsets
  /// in x + offsets in y + heading weights)).
  void move(const MotionKernel& kernel);

  /// [Markov1998] eq. 4: active states are multiplied by P(s | l), the rest by P~(s). `log_best_over_mean` is the sum
  /// over beams of ln(best P(d | o)) - ln P~(d), tempered like the costs. Then, with a small probability `teleport`,
  /// somebody carried the robot elsewhere. Departures, see EvidenceWeights. `others`: what other sensors say, asked for
  /// places with an active state; empty: nothing. `log_best_over_mean` is then theirs, too. O(active states * beams).
  /// @pre beams in the order of directions
  void reweigh(const RangeTable& table, std::span<const BeamCosts> beams, double log_best_over_mean,
               const EvidenceWeights& weights, double teleport, const PlaceCosts& others = {});

  /// What a search has found inside a neighbourhood; the mass of the neighbourhood as a whole stays. O(kept states).
  void gather(const Gathering& gathering);

  /// Shares `mass` evenly over all states, in proportion taken from the others.
  void flood(double mass);

  [[nodiscard]] const StateSpace& space() const { return *space_; }
  /// States above it are active; negative: all are.
  [[nodiscard]] double threshold() const { return threshold_; }
  [[nodiscard]] double sea_level() const { return sea_; }
  [[nodiscard]] std::size_t active_states() const { return active_states_; }
  [[nodiscard]] double active_mass() const { return active_mass_; }
  [[nodiscard]] float peak() const { return peak_; }
  [[nodiscard]] std::span<const std::int32_t> kept_places() const { return kept_; }
  /// Of the index-th kept place.
  [[nodiscard]] Row row(std::size_t index) const {
    return {rows_.data() + index * stride_, static_cast<std::size_t>(space_->headings()), scale()};
  }
  /// No probability of the index-th kept place is above it: others need not be looked for there.
  [[nodiscard]] float row_peak(std::size_t index) const { return contents_[index].peak; }
  /// Of all headings of the index-th kept place, within 1e-6 of itself; nullopt: nobody has added them up.
  [[nodiscard]] std::optional<double> row_mass(std::size_t index) const;
  /// A bit for each block of kRowBlock headings of the index-th kept place that has a probability above its level.
  /// @param levels  [row_stride()]
  [[nodiscard]] std::uint64_t blocks_above(std::size_t index, std::span<const float> levels) const {
    return kernels_->active_blocks(rows_.data() + index * stride_, {scale_, bias_, levels});
  }
  /// All of row(index), and zeros up to whole blocks. @param out  [row_stride()]
  void read_row(std::size_t index, std::span<float> out) const {
    kernels_->expand(rows_.data() + index * stride_, scale(), out.data());
  }
  [[nodiscard]] std::size_t row_stride() const { return stride_; }
  [[nodiscard]] float probability(std::size_t place, int heading) const;
  [[nodiscard]] double entropy() const;  ///< [nat], eq. 5

  /// @pre this processor has it. The widest one is the default.
  void use(InstructionSet set);
  [[nodiscard]] InstructionSet instruction_set() const { return set_; }

 private:
  void keep_all(float value);
  void fill_row(std::size_t index, float value);
  template <class Visitor>
  void for_states_near(const BeliefMode& mode, const Visitor& visit) const;
  [[nodiscard]] bool is_all_active(std::size_t index) const {
    return contents_[index].active == static_cast<std::uint32_t>(space_->headings());
  }
  void wake();
  [[nodiscard]] RowScale scale() const { return {scale_, bias_, limit_}; }
  void set_scale(double scale, double bias);
  /// Fills costs_ where states are active; the least of them.
  std::size_t score(const RangeTable& table, std::span<const BeamCosts> beams, const EvidenceWeights& weights,
                    const PlaceCosts& others);
  /// The neighbourhood of EvidenceWeights::focus among the kept states.
  struct Focus {
    std::vector<std::size_t> rows;       ///< indices into kept_, ascending
    std::vector<std::uint8_t> headings;  ///< [headings] 1: in focus
    std::size_t best = 0;                ///< cost
    float scale = 0.0F;                  ///< what the slow evidence gives to the neighbourhood as a whole
  };
  [[nodiscard]] Focus focus_of(const EvidenceWeights& weights, const RowEvidence& slow) const;
  void reweigh_in_focus(std::size_t index, const Focus& focus, const EvidenceWeights& weights, const RowEvidence& slow,
                        RowTotals& totals);
  /// Rows hold `totals`, the sea its old level: makes the whole sum to 1, and lets `teleport` of it be uniform.
  /// `wants_entropy`: it is asked for next, and the rows are at hand.
  void normalise(const RowTotals& totals, double teleport, bool wants_entropy = false);
  void settle(bool wants_entropy = false);
  [[nodiscard]] double entropy_of(double sum_p_log_p, std::size_t active) const;
  [[nodiscard]] RowTotals totals() const;

  void find_targets(int reach);
  /// Asks the cache for a row that will be read soon: belief and costs are larger than caches, and rows that are taken
  /// by their places come too irregularly for the processor to foresee.
  void prefetch_row(std::size_t index) const {
    const float* const row = rows_.data() + std::min(index, kept_.size() - 1) * stride_;
    for (std::size_t h = 0; h < stride_; h += kRowBlock) __builtin_prefetch(row + h);
  }

  void make_room(const MotionKernel& kernel);
  void count_targets(int row, int sign, std::span<const std::size_t> target_begin);
  void mix_line(int row, const MotionKernel& kernel);
  void find_lines(int low, int reach);
  void move_column(std::size_t column, const MotionKernel& kernel, std::span<const std::int32_t> targets,
                   RowTotals& totals);
  [[nodiscard]] float* mixed_line(int row) { return mixed_.data() + static_cast<std::size_t>(row) % ring_ * line_; }

  const StateSpace* space_;
  std::size_t stride_;  ///< [floats] of a row: whole blocks
  double threshold_;
  InstructionSet set_ = InstructionSet::plain;
  const RowKernels* kernels_ = nullptr;

  std::vector<std::int32_t> kept_;  ///< places, ascending
  std::vector<std::int32_t> slot_;  ///< of each place: index in kept_, or -1
  AlignedVector<float> rows_;       ///< [kept][stride], times scale_, plus bias_; room for all places
  /// [kept]: of the probabilities since the last pass over them.
  std::vector<RowContent> contents_;
  float scale_ = 1.0F;
  AlignedVector<float> bias_;   ///< [stride]
  AlignedVector<float> limit_;  ///< [stride]: the threshold
  double sea_ = 0.0;            ///< a probability
  std::size_t active_states_ = 0;
  double active_mass_ = 1.0;
  float peak_ = 0.0F;
  std::optional<double> entropy_;  ///< [nat], when it was found in passing

  AlignedVector<std::uint16_t> costs_;  ///< scratch of reweigh: [kept][stride]
  // Scratch of move.
  std::vector<std::int32_t> targets_;
  std::vector<std::uint8_t> marks_;   ///< [places]
  std::vector<int> asked_;            ///< [columns] targets about a line of cells
  AlignedVector<float> expanded_;     ///< a stretch of a line of cells
  AlignedVector<float> mixed_;        ///< [ring][columns][stride]: lines after the pass along x
  std::size_t ring_ = 1, line_ = 0;   ///< lines of mixed_; floats of one
  AlignedVector<float> extended_;     ///< [kRowGroup] rows of headings, with the reach of the blur before and behind
  AlignedVector<float> fours_;        ///< and their sums of four
  AlignedVector<float> nothing_;      ///< a line of zeros
  std::vector<const float*> around_;  ///< the lines about a target
};

}  // namespace docent::localization
