#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/localization/beam_choice/beam_filter.h"
#include "docent/localization/belief/neighbourhood.h"
#include "docent/localization/belief/pose_refiner.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/judgement/tracks.h"
#include "docent/localization/judgement/verdict.h"
#include "docent/motion_models/odometry_model.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// What grid and particles share, section `localize` of robot.yaml.
struct LocalizerParams {
  StateSpaceParams states;                     ///< cells of position and heading
  sensor_models::ProximityModelParams sensor;  ///< how the lasers err
  motion_models::OdometryModelParams motion;   ///< how odometry errs
  VerdictParams verdict;                       ///< when to say "here"
  PoseRefinerParams refiner;                   ///< from a cell to centimetres
  TracksParams tracks;                         ///< the places that the whole way leaves possible
  int beams = 60;                              ///< at most, per update
  double independent_beams = 12.0;             ///< what so many correlated beams are worth
  double independent_beams_far = 3.5;          ///< and, once the robot is sure of a place, between it and others
  int sectors = 12;               ///< of a turn: one thing that the map does not know hides the beams of a sector
  double most_sector_nats = 5.0;  ///< [nat] that a sector's beams count at most together
  /// and, in the grid, while the robot has no place to keep and walls are where the map says (`exact_walls`): people
  /// are out by their shape then, and beams through walls must cost more than those that are hidden. Where shapes take
  /// out most beams, some of the others are of people, too, and it is as above.
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
  bool exact_walls = true;             ///< the map's walls are where it says
  double most_views = 4.0;             ///< >= 1: what a scan after a long way is worth, see views()
  double most_nats = 8.0;              ///< [nat] that one scan counts at most
  double most_nats_far = 2.0;          ///< and, once the robot is sure of a place, between it and others
  double focus_radius = 0.75;          ///< [m] about the place that the robot is sure of: evidence is sharp there
  double focus_turn = 0.45;            ///< [rad] likewise
  double focus_deviations = 8.0;       ///< of odometry's error since the last update that are in focus all the same
  int most_states_asked = 300000;      ///< active states up to which sensors beside the lasers are asked
  double work_per_second = 1e9;        ///< states * beams that may be scored in a second of the robot's time
  bool cuts_at_reach = true;           ///< false: crippled, for evaluation: far readings are held against near ones
  bool reckons_dead = false;           ///< crippled, for evaluation: once it is sure it looks no more
  std::string simd = "auto";           ///< auto (the widest there is), plain, avx2, avx512: same belief, other speed

  // Not of robot.yaml.
  /// P(d | o) of your own; `sensor` then gives max_range and the Gaussian of the filters. Null: its mixture. The
  /// verdict asks no model: readings half a metre beyond walls contradict the map.
  std::shared_ptr<const sensor_models::ReadingDistribution> own_sensor;
  template <class V>
  void visit(V& v) {
    v("states", states);
    v("sensor", sensor);
    v("motion", motion);
    v("verdict", verdict);
    v("refiner", refiner);
    v("tracks", tracks);
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
    v("exact_walls", exact_walls);
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
  [[nodiscard]] std::vector<std::uint8_t> on_persons(const sensor_models::RangeSweep& sweep,
                                                     bool keeps_its_place) const;
  /// How beams are chosen.
  [[nodiscard]] BeamChoiceParams beam_choice(std::vector<std::uint8_t> on_persons, bool keeps_its_place) const;
};

}  // namespace docent::localization
