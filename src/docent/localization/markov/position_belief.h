#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/markov/motion_kernel.h"
#include "docent/localization/markov/range_table.h"
#include "docent/localization/markov/score_kernel.h"
#include "docent/localization/markov/state_space.h"

namespace docent {

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
  std::optional<Pose2> focus;
  double focus_radius = 0.75;  ///< [m]
  double focus_turn = 0.45;    ///< [rad]
};

/// P(L = l) over all states of a StateSpace, with the selective update of [Markov1998] 3.1.
///
/// States at or below the threshold are not updated; all of them share one value, the sea level. Places with a state
/// above the threshold are kept as rows of headings, ascending by place; all other places are nothing but sea. States
/// of a kept row that are under water hold the sea level themselves, so that a row is a plain array for every loop.
/// When the sea rises over the threshold, every state is above it, and all places are kept again: all wake.
class PositionBelief {
 public:
  /// `threshold_fraction`: the threshold as a share of the a priori probability 1 / states; 0.001 in [Rhino1999] 3.1.5.
  /// With 0 no state ever sinks: the plain, dense algorithm. `space` must outlive the belief.
  PositionBelief(const StateSpace& space, double threshold_fraction);

  void make_uniform();
  /// Gaussians; what their masses leave out is uniform, and at least `uniform_mass` is.
  void make_modes(std::span<const BeliefMode> modes, double uniform_mass);

  /// [Markov1998] eq. 2. Mass that would leave the free places is taken out and shared by all. O(kept places * offsets
  /// * headings).
  void move(const MotionKernel& kernel);

  /// [Markov1998] eq. 4: active states are multiplied by P(s | l), the rest by P~(s). `log_best_over_mean` is the sum
  /// over beams of ln(best P(d | o)) - ln P~(d), tempered like the costs. Then, with a small probability `teleport`,
  /// somebody carried the robot elsewhere. Departures, see EvidenceWeights. O(active states * beams).
  void reweigh(const RangeTable& table, std::span<const BeamCosts> beams, double log_best_over_mean,
               const EvidenceWeights& weights, double teleport);

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
  /// Probabilities of all headings of the index-th kept place.
  [[nodiscard]] std::span<const float> row(std::size_t index) const {
    return {rows_.data() + index * stride_, static_cast<std::size_t>(space_->headings())};
  }
  [[nodiscard]] float probability(std::size_t place, int heading) const;
  [[nodiscard]] double entropy() const;  ///< [nat], eq. 5

  /// For tests and benchmarks: an instruction set by hand.
  void use_kernel(ScoreKernel kernel) { score_ = kernel; }

 private:
  void keep_all(float value);
  void wake();
  /// Fills costs_ where states are active; the least of them.
  std::size_t score(const RangeTable& table, std::span<const BeamCosts> beams, const EvidenceWeights& weights);
  /// The neighbourhood of EvidenceWeights::focus among the kept states.
  struct Focus {
    std::vector<std::uint32_t> rows;     ///< indices into kept_
    std::vector<std::uint8_t> headings;  ///< [headings] 1: in focus
    std::size_t best = 0;                ///< cost
  };
  [[nodiscard]] Focus focus_of(const EvidenceWeights& weights) const;
  void normalise(double teleport);
  void settle(double inactive_mass, std::size_t inactive_states);
  void find_targets(int reach, std::vector<std::int32_t>& targets);
  void move_row(std::int32_t target, const MotionKernel& kernel, float* out);

  const StateSpace* space_;
  std::size_t stride_;  ///< [floats] of a row; a multiple of 64
  double threshold_;
  ScoreKernel score_;
  std::vector<float> decay_;      ///< exp(-cost / kCostPerNat)
  std::vector<float> far_decay_;  ///< scratch of reweigh: the slow evidence's factor of a cost above the best

  std::vector<std::int32_t> kept_;  ///< places, ascending
  std::vector<std::int32_t> slot_;  ///< of each place: index in kept_, or -1
  std::vector<float> rows_;         ///< [kept][stride]
  double sea_ = 0.0;
  std::size_t active_states_ = 0;
  double active_mass_ = 1.0;
  float peak_ = 0.0F;

  std::vector<float> next_rows_;      ///< scratch of move
  std::vector<std::uint16_t> costs_;  ///< scratch of reweigh: [kept][stride]
  std::vector<std::int32_t> targets_;
  std::vector<std::uint8_t> marks_;
  std::vector<float> shifted_;
  std::vector<float> extended_;
};

}  // namespace docent
