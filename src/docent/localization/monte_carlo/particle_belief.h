#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/instruction_set.h"
#include "docent/localization/localizer/known_map.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/localization/localizer/pose_belief.h"
#include "docent/localization/monte_carlo/likelihood_field.h"
#include "docent/localization/monte_carlo/scan_proposal.h"
#include "docent/localization/monte_carlo/sweep_scores.h"
#include "docent/localization/particles/noise_streams.h"
#include "docent/localization/particles/particle_set.h"
#include "docent/localization/particles/resampling.h"

namespace docent::localization {

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

/// The belief as weighted samples [Minerva2000] 3.3, for the cycle of `Localizer`. Their number follows from the
/// breadth of the belief (KLD-sampling) and from the computing time there is.
///
/// Recovery: with a small probability the truth is nowhere near a particle, because somebody carried the robot or
/// because the samples died out there. Then the pose has the density p(z | x) over all poses: it is drawn from
/// (ScanProposal), and weighs as much as that case is probable. What lies away from the likeliest place is a stratum of
/// its own, which keeps some particles however little they weigh, so that rivals live until they are refuted: as the
/// grid's sea, not as a draw by weight alone, in which a thousandth of the mass among three hundred particles is gone.
class ParticleBelief final : public PoseBelief {
 public:
  ParticleBelief(std::shared_ptr<const KnownMap> map, const LocalizerParams& shared, const MonteCarloParams& params,
                 std::uint64_t seed);

  void start_unknown() override;
  void set_out(const Pose2& odom_from_robot) override;
  /// Particles only near the modes: nothing is kept elsewhere.
  void believe(std::span<const BeliefMode> modes, double elsewhere, Rng& rng) override;
  void predict(const Motion& motion, const Pose2& odom_from_robot, bool keeps_its_place) override;
  /// O(particles * beams), and when it does not know its place O(grid states * beams).
  Reweighed reweigh(const SensorEvidence& evidence, Rng& rng) override;
  void resample(const Pose2& likeliest, Rng& rng) override;
  void gather(const Pose2& found, const Neighbourhood& focus, double share) override;
  bool flood() override;
  [[nodiscard]] BeliefSummary summarise() override;
  [[nodiscard]] std::vector<LikelyState> likely() const override;
  [[nodiscard]] PositionDensity density() const override;
  [[nodiscard]] Pose2 odom_from_frame() const override { return odom_from_robot_; }
  [[nodiscard]] sensor_models::RangeSweep in_frame(const sensor_models::RangeSweep& sweep) const override {
    return sweep;
  }
  [[nodiscard]] Pose2 map_from_frame(const Pose2& map_from_robot) const override { return map_from_robot; }

  [[nodiscard]] const ParticleSet& particles() const { return particles_; }
  void use_kernels(FieldKernel field, InstructionSet grid);

 private:
  /// What the sensors beside the lasers say in one update.
  struct Others {
    double steps_per_nat = 0.0;  ///< of costs; 0: they say nothing
    std::optional<float> least;  ///< [nat] of a particle that was asked: it costs nothing
  };
  /// Of one update, beside its evidence.
  struct Scoring {
    double temper = 1.0;  ///< what a nat counts in a full update
    double weight = 1.0;  ///< 0..1 of a full update
    double likelihood = 0.0;
    double work = 0.0;  ///< states * beams
    Others others{};
  };
  void reweigh_particles(const SensorEvidence& evidence, Scoring& scoring);
  void notice_surprise(double likelihood, double weight, double views);
  /// Adds poses drawn from the sensors, for the case that the truth is near no particle.
  void draw_elsewhere(const SensorEvidence& evidence, Scoring& scoring, Rng& rng);
  /// How many poses are drawn; 0: this time none.
  [[nodiscard]] std::size_t draws(bool knows, double surprise);
  /// Importance weights: what was drawn by the table is weighed by the model in use. Returns their sum.
  double weigh(ScanProposal& proposal, const SensorEvidence& evidence, Scoring& scoring);
  [[nodiscard]] Others ask_sensors(const SensorEvidence& evidence, double temper) const;
  void add_others(ObservationModels& sensors, Others& others, const ParticleSet& particles,
                  std::vector<std::uint32_t>& costs) const;
  [[nodiscard]] std::size_t most_particles() const;

  std::shared_ptr<const KnownMap> map_;
  LocalizerParams shared_;
  MonteCarloParams params_;
  SweepScores scores_;
  InstructionSet instructions_;
  NoiseStreams noise_;
  ParticleSet particles_;
  ParticleSet scratch_;
  Pose2 odom_from_robot_;                      ///< at the last update
  double long_mean_ = 0.0, short_mean_ = 0.0;  ///< of the evidence; 0: none yet
  double start_over_ = 0.0;                    ///< probability that all particles are wrong, told from outside
  int undrawn_ = 0;                            ///< updates since poses were drawn from the sensors
  std::size_t first_tile_ = 0;
};

}  // namespace docent::localization
