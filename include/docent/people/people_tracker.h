#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/people/sightings.h"
#include "docent/people/sightlines.h"

namespace docent::people {

/// How somebody is followed from scan to scan.
struct PeopleTrackerParams {
  double gate = 0.8;              ///< [m], > 0: a sighting farther from where a person was expected is somebody else
  double acceleration = 1.0;      ///< [m/s2], > 0: how people change their pace (standard deviation)
  double sighting_noise = 0.12;   ///< [m], > 0
  int sightings = 3;              ///< before somebody counts
  double patience = 0.5;          ///< [s] not seen where they should be seen, then forgotten
  double patience_unclear = 1.2;  ///< [s] the same where the beams do not tell
  double patience_hidden = 2.0;   ///< [s] hidden behind others
  double fastest = 2.5;           ///< [m/s] that a person can move
  double step = 0.45;             ///< [m] away from where they were first seen: moves, and is no thing
  double beside = 0.4;            ///< [m], >= 0: who begins so near to somebody may be their other leg
  int beside_sightings = 4;       ///< more of them, both seen at once, before such a one counts
  template <class V>
  void visit(V& v) {
    v("gate", gate);
    v("acceleration", acceleration);
    v("sighting_noise", sighting_noise);
    v("sightings", sightings);
    v("patience", patience);
    v("patience_unclear", patience_unclear);
    v("patience_hidden", patience_hidden);
    v("fastest", fastest);
    v("step", step);
    v("beside", beside);
    v("beside_sightings", beside_sightings);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Somebody, now.
struct TrackedPerson {
  std::uint32_t id = 0;  ///< the same for as long as the person is tracked
  Point2 position;       ///< [m]
  Point2 velocity;       ///< [m/s]
};

/// One track and what is known of it. Both axes have the same variances, so one 2 x 2 matrix serves both.
struct PersonTrack {
  TrackedPerson person;                 ///< the estimate
  double pp = 0.0, pv = 0.0, vv = 0.0;  ///< covariance of position and velocity along an axis
  double radius = 0.22;                 ///< [m]
  double breadth = 0.0;                 ///< [m] running mean, see PersonSighting
  int sightings = 1;                    ///< so far
  int doubts = 0;                       ///< sightings that it lacks yet, having begun beside somebody
  double missed = 0.0;                  ///< 0..1 of the patience
  Time seen;                            ///< last
  Point2 anchor;                        ///< [m] where it was first seen, or last stood
  int away = 0;                         ///< sightings in a row a step away from the anchor
  bool moved = false;                   ///< it has gone a step
  double come = 0.0;                    ///< running share of the sightings where the floor was free before
  bool came = false;                    ///< it was seen to come, soon after it was first seen
  double by_map = 0.0;                  ///< running share of the sightings that are surely not the map
  double thing_gain = 0.0;              ///< [nat] running mean, see BodyFit
  [[nodiscard]] bool is_seen_now(Time now) const { return seen == now; }  ///< seen at this moment
  /// It was seen to come or to go: then it is alive.
  [[nodiscard]] bool is_alive() const;
};

/// Follows people from sighting to sighting: a Kalman filter of constant velocity each, joined to the nearest sighting.
/// A person who is not seen is kept as long as the sweep allows: shortly where beams pass, longer behind others. In
/// odometry's frame, so that it does not matter whether the robot knows its place.
class PeopleTracker {
 public:
  explicit PeopleTracker(const PeopleTrackerParams& params) : params_{params} {}  ///< nobody yet

  /// Moves all tracks to a time; times must not fall, an older one counts as now. O(tracks).
  void predict(Time time);
  /// Sightings of the predicted time. O(tracks * sightings).
  void update(std::span<const PersonSighting> sightings, const Sightlines& sightlines);
  [[nodiscard]] const std::vector<PersonTrack>& tracks() const { return tracks_; }  ///< by falling age
  [[nodiscard]] std::vector<Point2> places() const;  ///< where those are who were seen often enough
  /// Seen often enough to be told of.
  [[nodiscard]] bool is_confirmed(const PersonTrack& track) const {
    return track.sightings >= params_.sightings && track.doubts == 0;
  }
  void clear() { tracks_.clear(); }  ///< forgets all

 private:
  void correct(PersonTrack& track, const PersonSighting& sighting) const;
  void miss(PersonTrack& track, const Sightlines& sightlines) const;
  void begin(const PersonSighting& sighting);
  void doubt_second_legs();

  PeopleTrackerParams params_;
  std::vector<PersonTrack> tracks_;
  std::uint32_t next_id_ = 1;
  Time time_{};
  double seconds_ = 0.0;  ///< of the last prediction
};

}  // namespace docent::people
