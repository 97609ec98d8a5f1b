#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/localization/beam_choice/beam_filter.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/sonar/evidence/sonar_trust.h"
#include "docent/sensor_models/proximity_model.h"

namespace docent::localization {

/// Sonars beside lasers in one belief, [Rhino1999] 3.1: with a model, a number of beams and a filter of their own.
struct SonarEvidenceParams {
  int beams = 0;                    ///< at most, per update; 0: the sonars take no part in the belief
  double independent_beams = 3.0;   ///< > 0: what `beams` correlated ones are worth
  double most_nats = 2.0;           ///< [nat], > 0: that the sonars count at most in an update
  std::string filter = "distance";  ///< none, entropy, distance, novelty
  double filter_sureness = 0.99;    ///< 0.5..1, of the distance filter
  double unfiltered_share = 0.1;    ///< 0..1 of the filtered readings, chosen at random, counts anyway
  double cone = 15.0;               ///< [deg], > 0: full opening, in which the nearest thing is heard
  double oldest = 0.5;              ///< [s], > 0: readings older than this are not carried on by odometry
  bool trusting = false;            ///< crippled, for evaluation: readings of frozen and deaf sonars count as well
  /// As learned amid visitors in both museums of the repository, rounded between the two.
  sensor_models::ProximityModelParams model{5.0, 0.06, 0.02, 0.35, 0.28, 0.06, 4.0, 0.36, 0.16, 0.14};
  template <class V>
  void visit(V& v) {
    v("beams", beams);
    v("independent_beams", independent_beams);
    v("most_nats", most_nats);
    v("filter", filter);
    v("filter_sureness", filter_sureness);
    v("unfiltered_share", unfiltered_share);
    v("cone", cone);
    v("oldest", oldest);
    v("model", model);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One reading of one sonar of the ring.
struct SonarPing {
  Time time;
  int sonar = 0;
  Pose2 base_from_sonar;
  Pose2 odom_from_base;    ///< then
  double range = 0.0;      ///< [m] from the sonar; NaN: no reading
  double max_range = 5.0;  ///< [m]; this or more: no echo
};

/// The last echo of each sonar, as evidence for the belief.
///
/// A sonar hears the nearest thing in its cone, so what it expects is the shortest range over the cone's directions
/// (RangeTable::cones, made of the lasers' table: no ray is cast for it). P(d | o) is the mixture of [Markov1998] 3.2
/// with the sonars' parameters, as `docent-lab learn-sensor-model --sensor sonar` learns them.
class SonarEvidence final : public ObservationModel {
 public:
  /// `rays`, with ranges in the bins of `rays_model`: the lasers' table, of which a copy for cones is made. `space`
  /// must outlive the object. @pre params are valid, params.beams > 0
  SonarEvidence(const SonarEvidenceParams& params, int sonars, const StateSpace& space, const RangeTable& rays,
                const sensor_models::ProximityModel& rays_model, std::uint64_t seed);

  /// @pre 0 <= ping.sonar < sonars
  void hear(const SonarPing& ping);
  /// Untrustworthy sonars have nothing to say. O(likely poses * directions).
  bool observe(const ObservationMoment& moment) override;
  /// O(poses * beams)
  void add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const override;
  [[nodiscard]] double mean_cost() const override;

  [[nodiscard]] const SonarTrust& trust() const { return trust_; }
  [[nodiscard]] std::size_t beams_used() const { return beams_.size(); }  ///< in the last update
  [[nodiscard]] std::size_t beams_filtered() const { return filtered_; }  ///< in the last update

 private:
  struct Beam {
    double range = 0.0;      ///< [m] from the robot's centre
    Point2 along;            ///< unit vector, robot frame
    double direction = 0.0;  ///< bearing in heading steps, 0..headings
    int bin = 0;             ///< of the range
  };
  struct Ear {
    SonarPing ping;
    bool is_new = false;
  };
  [[nodiscard]] sensor_models::RangeSweep fresh_sweep(const ObservationMoment& moment);
  [[nodiscard]] std::vector<sensor_models::BinnedBeam> filtered(const sensor_models::RangeSweep& sweep,
                                                                std::span<const LikelyPose> likely);
  [[nodiscard]] std::vector<LikelyState> states_of(std::span<const LikelyPose> likely) const;
  [[nodiscard]] Agreement compare(const ExpectedRanges& expected, int direction, int bin) const;
  [[nodiscard]] double heading_steps(Angle angle) const;  ///< 0..headings
  [[nodiscard]] int bin_of(const sensor_models::SweepBeam& beam) const {
    return beam.no_return ? sensor_models::kNoReturn : model_.bin(beam.range);
  }
  [[nodiscard]] float cost_at(const Pose2& map_from_robot) const;

  SonarEvidenceParams params_;
  BeamFilter filter_;
  const StateSpace* space_;
  sensor_models::ProximityModel bins_;  ///< ranges to bins, before the table is known
  RangeTable table_;                    ///< of cones
  sensor_models::ProximityModel model_;
  std::vector<float> costs_;          ///< [measured][expected]: ln of the best P(d | o) less ln P(d | o), tempered
  std::vector<std::uint8_t> bin_at_;  ///< of a range in centimetres
  SonarTrust trust_;
  Rng rng_;
  std::vector<Ear> ears_;
  std::vector<Beam> beams_;  ///< of the last update
  std::size_t filtered_ = 0;
  std::size_t phase_ = 0;
};

}  // namespace docent::localization
