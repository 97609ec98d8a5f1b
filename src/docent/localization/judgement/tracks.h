#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/localization/belief/place_search.h"
#include "docent/localization/judgement/part_sums.h"
#include "docent/localization/judgement/search_watch.h"
#include "docent/motion_models/odometry_model.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// How places are told apart by the whole way since they parted.
struct TracksParams {
  double spacing = 0.4;           ///< [m] between views, or
  double turned = 30.0;           ///< [deg] turned
  int most_views = 80;            ///< views that are kept: the way that evidence reaches back
  int most_tracks = 32;           ///< ways that are followed
  int beams = 90;                 ///< of a view
  double nats = 3.0;              ///< [nat] that a part of the building says at most; less where walls are off
  double part = 0.5;              ///< [m] side of a part of the floor: what stands there and is not in the map
  double wall_part = 0.5;         ///< [m] of a wall
  double first_short = 4.5;       ///< [nat] that readings say at the full cost which end where there is nothing; and
  double too_short = 0.15;        ///< 0..1 of it for more of them: people end readings anywhere
  double part_beams = 10.0;       ///< readings that count half of what many of one part do
  double hopeless = 15.0;         ///< [nat] behind the best: a way that is followed no longer
  double given = 6.0;             ///< [nat] that a start which somebody gave is likelier than other places
  double followed = 6.0;          ///< [nat] likewise, the way that it has followed for the last `most_views` views
  double carried_off = 9.0;       ///< [nat] that it costs to say: somebody has carried the robot; and
  double startled = 2.0;          ///< [nat] where what it saw changed at once
  double startled_given = 2.0;    ///< [nat] likewise, where somebody has told the start
  double most_heard = 12.0;       ///< [nat] that other sensors say at most
  double search_way = 1.5;        ///< [m] after which the whole map is searched anew, while the robot is unsure;
  double search_way_kept = 6.0;   ///< [m] while it is sure, but in doubt or not for long;
  double search_way_calm = 48.0;  ///< [m] and at most, of a robot that has long been sure, and
  double usual_nats = 0.8;        ///< [nat] against its place in the mean of the views, at most; by so much
  double doubt_nats = 3.0;        ///< [nat] more in sum it searches at once: see SearchWatch
  template <class V>
  void visit(V& v) {
    v("spacing", spacing);
    v("turned", turned);
    v("most_views", most_views);
    v("most_tracks", most_tracks);
    v("beams", beams);
    v("nats", nats);
    v("part", part);
    v("wall_part", wall_part);
    v("first_short", first_short);
    v("too_short", too_short);
    v("part_beams", part_beams);
    v("hopeless", hopeless);
    v("given", given);
    v("followed", followed);
    v("carried_off", carried_off);
    v("startled", startled);
    v("startled_given", startled_given);
    v("most_heard", most_heard);
    v("search_way", search_way);
    v("search_way_kept", search_way_kept);
    v("search_way_calm", search_way_calm);
    v("usual_nats", usual_nats);
    v("doubt_nats", doubt_nats);
  }
  [[nodiscard]] Result<void> validate() const;
  [[nodiscard]] SearchWatchParams search() const {
    return {search_way, search_way_kept, search_way_calm, usual_nats, doubt_nats};
  }
};

/// The ways that the robot may have come, one for every place that was ever likely: each is followed by odometry and
/// the map through the views of the last thirty metres, forward and back. A belief forgets; what it has all but ruled
/// out at one spot, by walls that the survey has two centimetres off, never comes back by itself. Ways do not: they
/// are compared by all that was seen since they parted, and what the map has wrong counts once. docs/decisions/0047.
class Tracks {
 public:
  Tracks(const TracksParams& params, const motion_models::OdometryModelParams& motion, double max_range,
         const sensor_models::RayCaster& caster)
      : params_{params},
        motion_{motion},
        max_range_{max_range},
        caster_{&caster},
        search_watch_{params.search()},
        startled_{params.startled} {}

  void forget();
  /// Somebody has told where the robot is.
  void start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot);

  /// Whether the next sweep is to be a view. `is_startled`: it is of another place than the last, as it seems.
  [[nodiscard]] bool is_due(const Pose2& odom_from_robot, bool is_startled) const;
  /// Carries every track on to this view. `best`: where the belief has the robot, if anywhere: the track there follows
  /// it. O(tracks * beams).
  void add_view(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_robot, bool is_startled,
                const std::optional<Pose2>& best);
  /// Follows a track back from each of these poses of the last view, but from those that are known. O(poses * views *
  /// beams).
  void take_in(std::span<const Pose2> map_from_robot);
  /// Whether the whole map is to be searched at this view. `in_doubt`: other signs speak against the robot's place.
  [[nodiscard]] bool is_search_due(bool keeps_its_place, bool in_doubt) const;
  void search(const PlaceSearch& places);
  /// What other sensors say of the tracks now, for `weight` of an update. O(tracks).
  void hear(const ObservationModels& others, double weight, const Pose2& odom_from_robot);

  struct Place {
    Pose2 map_from_robot;
    double share = 0.0;  ///< 0..1, of all tracks' probability
  };
  /// Where the robot may be now, by falling share.
  [[nodiscard]] std::vector<Place> places(const Pose2& odom_from_robot) const;

 private:
  struct View {
    sensor_models::RangeSweep sweep;
    Pose2 odom_from_robot;
    bool is_startled = false;
  };
  struct Track {
    std::deque<Pose2> poses;                  ///< at the views, from `since` on
    std::deque<std::vector<PartCost>> costs;  ///< likewise
    std::size_t since = 0;                    ///< index of the first view that it explains
    PartSums sums;
    double past = 0.0;   ///< [nat] that speaks against it besides: before `since`, or before what is kept
    double heard = 0.0;  ///< [nat] of other sensors
  };
  [[nodiscard]] double nats(const Track& track) const;
  [[nodiscard]] double least_nats() const;
  [[nodiscard]] double nats(const PartSums& sums) const;
  [[nodiscard]] Pose2 now(const Track& track, const Pose2& odom_from_robot) const;
  [[nodiscard]] std::vector<PartCost> costs_at(const View& view, const Pose2& pose) const;
  [[nodiscard]] Pose2 followed(const Pose2& from, const View& view, const View& next) const;
  [[nodiscard]] Track followed_back(const Pose2& map_from_robot, std::span<const double> before) const;
  /// [nat] of the best way to explain the views before each, [views].
  [[nodiscard]] std::vector<double> best_before() const;
  void drop_first_view();
  /// Of one place, and the same way.
  [[nodiscard]] bool is_one_view(const Pose2& odom_from_robot, const Pose2& other) const;
  void prune();

  TracksParams params_;
  motion_models::OdometryModelParams motion_;
  double max_range_;
  const sensor_models::RayCaster* caster_;
  std::deque<View> views_;
  std::vector<Track> tracks_;
  SearchWatch search_watch_;
  double startled_;        ///< [nat] that it costs to have been carried off where what it saw changed
  double given_ = 0.0;     ///< [nat] against tracks that nobody has told of
  Pose2 odom_from_start_;  ///< as long as there is no view
};

}  // namespace docent::localization
