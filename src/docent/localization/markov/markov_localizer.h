#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/localization/belief/localizer.h"
#include "docent/localization/belief/neighbourhood.h"
#include "docent/localization/belief/pose_refiner.h"
#include "docent/localization/belief/rivals.h"
#include "docent/localization/markov/beam_filter.h"
#include "docent/localization/markov/position_belief.h"
#include "docent/localization/markov/position_summary.h"
#include "docent/localization/markov/range_table_cache.h"
#include "docent/motion_models/odometry_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent {

struct MarkovLocalizerParams {
  StateSpaceParams states;
  ProximityModelParams sensor;
  OdometryModelParams motion;
  VerdictParams verdict;
  PoseRefinerParams refiner;
  int beams = 60;                      ///< at most, per update
  double independent_beams = 12.0;     ///< what so many correlated beams are worth
  double independent_beams_far = 3.5;  ///< and, once the robot is sure of a place, between it and others
  int sectors = 12;                    ///< of a turn: one thing that the map does not know hides the beams of a sector
  double most_sector_nats = 5.0;       ///< [nat] that a sector's beams count at most together
  /// and, in the grid, while the robot has no place to keep and walls are where the map says (`rivals`): people are out
  /// by their shape then, and beams through walls must cost more than those that are hidden. Where shapes take out most
  /// beams, some of the others are of people, too, and it is as above.
  double most_sector_nats_lost = 12.0;
  std::string filter = "distance";  ///< none, entropy, distance, novelty
  double filter_sureness = 0.99;    ///< theta of [Markov1998] 3.3
  double unfiltered_share = 0.1;    ///< of the filtered beams, chosen at random, counts anyway: for recovery
  /// Of the beams on what is shaped like a person, chosen at random, that count while the robot does not know its
  /// place; 1: nobody looks for shapes
  double person_share = 0.1;
  double sea_threshold = 0.001;        ///< of the a priori probability
  double teleport_probability = 1e-7;  ///< per update: somebody carried the robot elsewhere
  double teleport_in_doubt = 0.02;     ///< and per update while the readings contradict the map
  double update_way = 0.25;            ///< [m] driven that is worth an update, or
  double update_turn = 10.0;           ///< [deg] turned, or
  double creeping_period = 2.0;        ///< [s] when it moves less, or
  double standing_period = 3.0;        ///< [s] when it stands
  double standing_weight = 0.1;        ///< of such an update: the same view again says little
  bool rivals = true;                  ///< see Rivals; for a map whose walls are where it says
  double most_views = 4.0;             ///< >= 1: what a scan after a long way is worth, see views()
  double most_nats = 8.0;              ///< [nat] that one scan counts at most
  double most_nats_far = 2.0;          ///< and, once the robot is sure of a place, between it and others
  double focus_radius = 0.75;          ///< [m] about the place that the robot is sure of: evidence is sharp there
  double focus_turn = 0.45;            ///< [rad] likewise
  double focus_deviations = 8.0;       ///< of odometry's error since the last update that are in focus all the same
  int most_states_asked = 300000;      ///< active states up to which sensors beside the lasers are asked
  double work_per_second = 1e9;        ///< states * beams that may be scored in a second of the robot's time
  std::string simd = "auto";           ///< auto (the widest there is), plain, avx2, avx512: same belief, other speed
  template <class V>
  void visit(V& v) {
    v("states", states);
    v("sensor", sensor);
    v("motion", motion);
    v("verdict", verdict);
    v("refiner", refiner);
    v("beams", beams);
    v("independent_beams", independent_beams);
    v("independent_beams_far", independent_beams_far);
    v("sectors", sectors);
    v("most_sector_nats", most_sector_nats);
    v("most_sector_nats_lost", most_sector_nats_lost);
    v("filter", filter);
    v("filter_sureness", filter_sureness);
    v("unfiltered_share", unfiltered_share);
    v("person_share", person_share);
    v("sea_threshold", sea_threshold);
    v("teleport_probability", teleport_probability);
    v("teleport_in_doubt", teleport_in_doubt);
    v("update_way", update_way);
    v("update_turn", update_turn);
    v("creeping_period", creeping_period);
    v("standing_period", standing_period);
    v("standing_weight", standing_weight);
    v("rivals", rivals);
    v("most_views", most_views);
    v("most_nats", most_nats);
    v("most_nats_far", most_nats_far);
    v("focus_radius", focus_radius);
    v("focus_turn", focus_turn);
    v("focus_deviations", focus_deviations);
    v("most_states_asked", most_states_asked);
    v("work_per_second", work_per_second);
    v("simd", simd);
  }
  [[nodiscard]] Result<void> validate() const;
  /// How many scans' evidence a scan carries after so much motion [m, rad]. What the map has wrong shows in scan after
  /// scan, so that evidence comes by the metre and not by the scan: sparse scans, with half a metre or 20 degrees and
  /// more between them, count for several. 1..most_views.
  [[nodiscard]] double views(double way, double turn) const;
  /// Where evidence is sharp for a robot that is sure of its place and has driven so far since it was `predicted`.
  [[nodiscard]] Neighbourhood focus(const Pose2& predicted, const Pose2& before_from_after) const;
  /// What a sector counts at most. `on_persons`: see below; empty once the robot has a place to keep.
  [[nodiscard]] double sector_nats(std::span<const std::uint8_t> on_persons) const;
  /// The beams on what is shaped like a person, while the robot does not know its place; empty: nobody looks.
  [[nodiscard]] std::vector<std::uint8_t> on_persons(const RangeSweep& sweep, bool keeps_its_place) const;
  [[nodiscard]] BeamChoiceParams beam_choice(std::vector<std::uint8_t> on_persons, bool keeps_its_place) const;
};

/// The range table of a map, from the cache where it has one for these parameters; else made, and kept there.
[[nodiscard]] RangeTable range_table_of(const OccupancyGrid& map, const MarkovLocalizerParams& params,
                                        const RangeTableCache& cache, const StateSpace& space, const RayCaster& caster);

/// Grid-based Markov localization [Markov1998], [Rhino1999] 3.1: a belief over all poses, from sweeps of range readings
/// and odometry. Deterministic; knows no wall clock.
class MarkovLocalizer final : public Localizer {
 public:
  /// `cache`: see range_table_of. @pre params are valid
  MarkovLocalizer(const OccupancyGrid& map, const MarkovLocalizerParams& params, const RangeTableCache& cache,
                  std::uint64_t seed);
  void start_unknown() override;
  void start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time) override;
  /// An update waits until the work of the last one is paid off, too. O(active states * beams).
  Step observe(const RangeSweep& sweep, const Pose2& odom_from_robot, Time time) override;
  [[nodiscard]] const BeliefSummary& summary() const override { return summary_; }
  [[nodiscard]] const Verdict& verdict() const override { return verdict_; }
  [[nodiscard]] const Pose2& odom_from_robot() const override { return odom_from_robot_; }
  [[nodiscard]] std::vector<float> entropy_gains(const RangeSweep& sweep, const Pose2& odom_now) const override;
  [[nodiscard]] PositionDensity density() const override;
  [[nodiscard]] const RayCaster& caster() const override { return caster_; }

  [[nodiscard]] const PositionBelief& belief() const { return belief_; }
  [[nodiscard]] const StateSpace& space() const { return space_; }
  [[nodiscard]] const RangeTable& table() const { return table_; }

 private:
  [[nodiscard]] double due_weight(double way, double turn, Time time) const;
  /// It has turned all round on the spot: what there is to see from here is seen, until people have moved.
  [[nodiscard]] bool goes_round() const { return turned_here_ > 2.0 * std::numbers::pi; }
  /// `seen`: the sweep in the belief's frame.
  [[nodiscard]] BeamChoice choose_beams(const RangeSweep& seen, std::vector<std::uint8_t> on_persons);
  /// What the sensors beside the lasers say now, for `weight` of an update; empty: nothing.
  [[nodiscard]] PlaceCosts ask_sensors(double weight);
  [[nodiscard]] std::optional<double> fit(const RangeSweep& seen, std::span<const BinnedBeam> beams) const;
  void move(const Pose2& before_from_after);
  void summarise_now();
  void believe(std::span<const BeliefMode> modes, double uniform_mass);
  /// After a search for the refined pose: the belief follows it inside the neighbourhood in focus.
  void gather(const Neighbourhood& focus);
  void keep_rivals(const RangeSweep& sweep, const Pose2& before_from_after, double weight);
  [[nodiscard]] Pose2 frame_from_robot() const { return inverse(odom_from_frame_) * odom_from_robot_; }
  void judge(const Evidence& evidence, const std::optional<Pose2>& predicted);

  MarkovLocalizerParams params_;
  RayCaster caster_;
  StateSpace space_;
  RangeTable table_;
  ProximityModel model_;
  CoarseCells coarse_;
  PositionBelief belief_;
  Verdict verdict_;
  PoseRefiner refiner_;
  Rivals rivals_;
  Rng rng_;
  double widest_;  ///< [m] from corner to corner of the map
  /// The belief is over a frame that goes along with the robot in whole cells and never turns, as odometry sees it:
  /// what odometry knows well need not be blurred by the grid. Between the two lie some centimetres and the robot's
  /// heading.
  Pose2 odom_from_frame_;
  Angle likeliest_heading_;  ///< of the frame in the map
  bool started_ = false;     ///< odometry of the last update is known
  Pose2 odom_from_robot_;
  Time last_update_{};
  double last_work_ = 0.0;
  Point2 turns_at_{};         ///< [m], odom
  double turned_here_ = 0.0;  ///< [rad] since it came there
  std::size_t phase_ = 0;
  BeliefSummary summary_;
  std::vector<LikelyState> likely_;
};

}  // namespace docent
