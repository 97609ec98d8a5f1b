#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/localization/belief/localizer.h"
#include "docent/localization/belief/rivals.h"
#include "docent/localization/markov/beam_filter.h"
#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/monte_carlo/likelihood_field.h"
#include "docent/localization/monte_carlo/noise_streams.h"
#include "docent/localization/monte_carlo/particle_motion.h"
#include "docent/localization/monte_carlo/particle_set.h"
#include "docent/localization/monte_carlo/resampling.h"
#include "docent/localization/monte_carlo/scan_proposal.h"
#include "docent/localization/monte_carlo/sweep_scores.h"

namespace docent {

/// What particles need besides what they share with the grid.
struct MonteCarloParams {
  std::string model = "beam";  ///< beam: expected ranges and ProximityModel; field: LikelihoodField
  int least = 300;             ///< particles, and what they are when tracking
  int most = 50000;            ///< particles
  int reserve = 1000;          ///< of them, in places that the belief does not hold likely
  KldParams kld;               ///< how many between least and most
  LikelihoodFieldParams field;
  double shake_position = 0.01;  ///< [m] standard deviation that every step adds
  double shake_heading = 0.2;    ///< [deg] likewise
  double resample_below = 0.5;   ///< of the particles that the weights are worth
  /// Probability, per update and while the robot does not know where it is, that no particle is near the truth.
  double deprived = 0.02;
  double surprise_slow = 0.03;  ///< 0..1: share of an update in the long mean of the evidence, and
  double surprise_fast = 0.25;  ///< in the short one
  int draw_every = 4;           ///< updates between two draws from the sensors while the robot knows its place
  template <class V>
  void visit(V& v) {
    v("model", model);
    v("least", least);
    v("most", most);
    v("reserve", reserve);
    v("kld", kld);
    v("field", field);
    v("shake_position", shake_position);
    v("shake_heading", shake_heading);
    v("resample_below", resample_below);
    v("deprived", deprived);
    v("surprise_slow", surprise_slow);
    v("surprise_fast", surprise_fast);
    v("draw_every", draw_every);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Monte Carlo localization [Minerva2000] 3.3: the belief as weighted samples. Their number follows from the breadth of
/// the belief (KLD-sampling) and from the computing time there is.
///
/// Recovery: with a small probability the truth is nowhere near a particle, because somebody carried the robot or
/// because the samples died out there. Then the pose has the density p(z | x) over all poses: it is drawn from
/// (ScanProposal), and weighs as much as that case is probable. What lies away from the likeliest place is a stratum of
/// its own, which keeps some particles however little they weigh, so that rivals live until they are refuted: as the
/// grid's sea, not as a draw by weight alone, in which a thousandth of the mass among three hundred particles is gone.
///
/// Shared with the grid are the sensor and motion models, filters, tempering (decision 0006), cadence and verdict.
class MonteCarloLocalizer final : public Localizer {
 public:
  /// `cache`: as for MarkovLocalizer, the same tables. @pre params are valid
  MonteCarloLocalizer(const OccupancyGrid& map, const MarkovLocalizerParams& shared, const MonteCarloParams& params,
                      const RangeTableCache& cache, std::uint64_t seed);
  void start_unknown() override;
  void start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time) override;
  /// O(particles * beams), and when it does not know its place O(grid states * beams).
  Step observe(const RangeSweep& sweep, const Pose2& odom_from_robot, Time time) override;
  [[nodiscard]] const BeliefSummary& summary() const override { return summary_; }
  [[nodiscard]] const Verdict& verdict() const override { return verdict_; }
  [[nodiscard]] const Pose2& odom_from_robot() const override { return odom_from_robot_; }
  [[nodiscard]] std::vector<float> entropy_gains(const RangeSweep& sweep, const Pose2& odom_now) const override;
  [[nodiscard]] PositionDensity density() const override;
  [[nodiscard]] const RayCaster& caster() const override { return caster_; }

  [[nodiscard]] const ParticleSet& particles() const { return particles_; }
  [[nodiscard]] const StateSpace& space() const { return space_; }
  [[nodiscard]] const RangeTable& table() const { return table_; }
  void use_kernels(FieldKernel field, InstructionSet grid);

 private:
  [[nodiscard]] double due_weight(double way, double turn, Time time) const;
  [[nodiscard]] BeamChoice choose_beams(const RangeSweep& sweep, std::vector<std::uint8_t> on_persons);
  void notice_surprise(double likelihood, double weight, double views);
  /// Adds poses drawn from the sensors, for the case that the truth is near no particle.
  void draw_elsewhere(const RangeSweep& sweep, std::span<const BinnedBeam> beams, double temper, double likelihood);
  [[nodiscard]] std::vector<BeamCosts> grid_costs(const RangeSweep& sweep, std::span<const BinnedBeam> beams,
                                                  double temper) const;
  /// What the sensors beside the lasers say in one update.
  struct Others {
    double steps_per_nat = 0.0;  ///< of costs; 0: they say nothing
    std::optional<float> least;  ///< [nat] of a particle that was asked: it costs nothing
  };
  [[nodiscard]] Others ask_sensors(double temper);
  void add_others(const ParticleSet& particles, std::vector<std::uint32_t>& costs);
  void summarise_now();
  void believe(std::span<const BeliefMode> modes);
  /// As the grid's.
  void gather(const Neighbourhood& focus);
  void keep_rivals(const RangeSweep& sweep, const Pose2& before_from_after, double weight);
  void judge(const Evidence& evidence, const std::optional<Pose2>& predicted);
  [[nodiscard]] std::optional<double> fit(const RangeSweep& sweep, std::span<const BinnedBeam> beams) const;
  [[nodiscard]] std::size_t most_particles() const;

  MarkovLocalizerParams shared_;
  MonteCarloParams params_;
  RayCaster caster_;
  StateSpace space_;
  RangeTable table_;
  ProximityModel model_;
  SweepScores scores_;
  InstructionSet instructions_;
  Verdict verdict_;
  PoseRefiner refiner_;
  Rivals rivals_;
  Rng rng_;
  double widest_;  ///< [m] from corner to corner of the map
  NoiseStreams noise_;
  ParticleSet particles_;
  ParticleSet scratch_;
  double long_mean_ = 0.0, short_mean_ = 0.0;  ///< of the evidence; 0: none yet
  double start_over_ = 0.0;                    ///< probability that all particles are wrong, told from outside
  bool started_ = false;
  Pose2 odom_from_robot_;
  Time last_update_{};
  double last_work_ = 0.0;
  std::size_t phase_ = 0;
  int undrawn_ = 0;  ///< updates since poses were drawn from the sensors
  std::size_t first_tile_ = 0;
  Others others_;
  BeliefSummary summary_;
  std::vector<LikelyState> likely_;
};

}  // namespace docent
