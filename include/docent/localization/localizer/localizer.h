#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/localization/beam_choice/beam_filter.h"
#include "docent/localization/beam_choice/beam_origin.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/localization/belief/pose_fix.h"
#include "docent/localization/belief/pose_refiner.h"
#include "docent/localization/judgement/tracks.h"
#include "docent/localization/judgement/verdict.h"
#include "docent/localization/localizer/known_map.h"
#include "docent/localization/localizer/localizer_params.h"
#include "docent/localization/localizer/pose_belief.h"
#include "docent/localization/localizer/update_cadence.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// Markov localization [Markov1998], [Rhino1999] 3.1: a belief over the robot's pose in a map, kept up by sweeps of
/// range readings and odometry. One cycle, whatever the belief is made of: see `observe`. Deterministic; knows no wall
/// clock.
class Localizer {
 public:
  /// @param rounds_repeat  see UpdateCadence
  Localizer(std::shared_ptr<const KnownMap> map, const LocalizerParams& params, std::unique_ptr<PoseBelief> belief,
            bool rounds_repeat, std::uint64_t seed);
  Localizer(const Localizer&) = delete;
  Localizer& operator=(const Localizer&) = delete;
  virtual ~Localizer() = default;

  /// Another sensor, whose observations count in every update from now on.
  void add_sensor(std::shared_ptr<ObservationModel> sensor) { sensors_.add(std::move(sensor)); }

  /// Another sensor has found the robot by itself. A robot that does not keep its place sets out from a fix that is
  /// sure; where it does, the fix bears its place out or speaks against it.
  void take_fix(const PoseFix& fix);

  void start_unknown();  ///< the robot may be anywhere
  /// `odom_from_robot`: where odometry saw the robot when it was as `modes` say.
  void start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time);

  /// Somebody has carried the robot since the last update, as its scans say: half of the belief goes elsewhere, and it
  /// knows nothing until it is confirmed anew.
  void uproot();

  /// What `observe` did.
  struct Step {
    bool updated = false;            ///< the belief has changed
    std::size_t beams_used = 0;      ///< that counted
    std::size_t beams_filtered = 0;  ///< of all beams of the sweep, one a direction
    double weight = 0.0;             ///< 0..1 of a full update
    /// Mean ln P(d | o) of the beams used, at the best mode: how well the map explains them. None without a mode.
    std::optional<double> fit;
  };
  /// Offers a sweep. Most are not needed: an update comes after some motion or time. One cycle is: due, predict, choose
  /// beams, reweigh, summarise, fit, judge. Odometry that jumped farther than the map's diagonal is torn, and the
  /// belief starts anew. Scanners may look farther than `sensor.max_range`, or less far. O(states of the belief *
  /// beams).
  Step observe(const sensor_models::RangeSweep& seen, const Pose2& odom_from_robot, Time time);

  [[nodiscard]] const BeliefSummary& summary() const { return summary_; }          ///< as of the last update
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }                ///< whether it may say "here"
  [[nodiscard]] const Pose2& odom_from_robot() const { return odom_from_robot_; }  ///< at the last update
  /// Entropy gains [nat] of the beams of a sweep, H(L | s) - H(L): above 0 the beam would make the robot less sure
  /// ([Rhino1999] eq. 10). 0 where it would tell nothing; empty while the belief is too wide to ask.
  [[nodiscard]] std::vector<float> entropy_gains(const sensor_models::RangeSweep& sweep, const Pose2& odom_now) const;
  [[nodiscard]] PositionDensity density() const { return belief_->density(); }           ///< for pictures
  [[nodiscard]] const sensor_models::RayCaster& caster() const { return map_->caster; }  ///< of the map
  [[nodiscard]] const StateSpace& space() const { return map_->space; }                  ///< the states of a grid
  [[nodiscard]] const RangeTable& table() const { return map_->table; }                  ///< expected ranges

  /// The best mode's mean, carried on by odometry; nullopt when there is no mode at all.
  [[nodiscard]] std::optional<Pose2> map_from_robot(const Pose2& odom_now) const {
    if (summary_.modes.empty()) return std::nullopt;
    return summary_.modes.front().map_from_robot * (inverse(odom_from_robot_) * odom_now);
  }
  /// What the beams of a sweep ended on, by the inverse filter. All unknown while not localized: then nobody can say
  /// what the map lets expect.
  [[nodiscard]] std::vector<sensor_models::BeamOrigin> origins(const sensor_models::RangeSweep& sweep,
                                                               const Pose2& odom_now, double max_range,
                                                               const PersonFilterParams& params) const;

 protected:
  [[nodiscard]] PoseBelief& pose_belief() { return *belief_; }              ///< what the belief is made of
  [[nodiscard]] const PoseBelief& pose_belief() const { return *belief_; }  ///< what the belief is made of

 private:
  /// One update, from step to step.
  struct Update {
    const sensor_models::RangeSweep& sweep;
    Motion motion;
    std::optional<Pose2> predicted;    ///< the best pose of the last update, moved by odometry
    double weight = 0.0;               ///< 0..1 of a full update
    double views = 1.0;                ///< LocalizerParams::views
    sensor_models::RangeSweep seen{};  ///< the sweep in the belief's frame
    std::vector<std::uint8_t> on_persons{};
    BeamChoice choice{};
    std::optional<Neighbourhood> focus{};
  };
  [[nodiscard]] bool is_torn(const Pose2& odom_from_robot) const;
  [[nodiscard]] Update due(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_robot, Time time);
  void predict(const Update& update, const Pose2& odom_from_robot, Time time);
  void choose_beams(Update& update);
  void reweigh(Update& update);
  void summarise(const Update& update);
  [[nodiscard]] std::optional<double> fit(const Update& update) const;
  void judge(Update& update);

  void summarise_now();
  void compare_tracks(const Update& update);
  /// The belief as the whole way has it, where it lacks a place that may be the right one.
  [[nodiscard]] std::optional<std::vector<BeliefMode>> belief_lacks() const;
  /// Of the best mode, among the places that the whole way leaves possible.
  [[nodiscard]] double share_of_best() const;
  void refine(const Update& update);
  /// P(wrong) of a fix of now that has the robot where its best mode is; above 1: it has it elsewhere.
  [[nodiscard]] std::optional<double> witness() const;
  void glance_at(const sensor_models::RangeSweep& sweep, const Pose2& map_from_robot);
  void forget_judgement();

  std::shared_ptr<const KnownMap> map_;
  LocalizerParams params_;
  std::unique_ptr<PoseBelief> belief_;
  ObservationModels sensors_;
  std::shared_ptr<FixEvidence> fixes_;  ///< null: no sensor gives any
  UpdateCadence cadence_;
  Verdict verdict_;
  PoseRefiner refiner_;
  Tracks tracks_;
  Rng rng_;
  bool is_uprooted_ = false;  ///< since the last update
  bool started_ = false;      ///< odometry of the last update is known
  Pose2 odom_from_robot_;
  std::size_t phase_ = 0;  ///< see `thinned`
  BeliefSummary summary_;
  std::vector<LikelyState> likely_;
};

}  // namespace docent::localization
