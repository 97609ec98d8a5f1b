#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/people/clusters.h"

namespace docent {

struct PeopleTrackerParams {
  double gate = 0.8;             ///< [m], > 0: a sighting farther from where a person was expected is somebody else
  double acceleration = 1.0;     ///< [m/s2], > 0: how people change their pace (standard deviation)
  double sighting_noise = 0.12;  ///< [m], > 0
  int sightings = 3;             ///< before somebody counts
  double patience = 1.2;         ///< [s] out of sight, then forgotten
  double fastest = 2.5;          ///< [m/s]
  template <class V>
  void visit(V& v) {
    v("gate", gate);
    v("acceleration", acceleration);
    v("sighting_noise", sighting_noise);
    v("sightings", sightings);
    v("patience", patience);
    v("fastest", fastest);
  }
  [[nodiscard]] Result<void> validate() const;
};

struct TrackedPerson {
  std::uint32_t id = 0;
  Point2 position;  ///< [m]
  Point2 velocity;  ///< [m/s]
};

/// Follows people from sighting to sighting: a Kalman filter of constant velocity each, joined to the nearest sighting.
class PeopleTracker {
 public:
  explicit PeopleTracker(const PeopleTrackerParams& params) : params_{params} {}

  /// Times must not fall; an older one counts as now. O(people * sightings).
  void update(std::span<const PersonSighting> sightings, Time time);
  [[nodiscard]] std::vector<TrackedPerson> people() const;  ///< who was seen often enough, by falling age
  void clear() { tracks_.clear(); }

 private:
  /// Both axes have the same variances, so one 2 x 2 matrix serves both.
  struct Track {
    TrackedPerson person;
    double pp = 0.0, pv = 0.0, vv = 0.0;  ///< covariance of position and velocity along an axis
    int sightings = 1;
    Time seen;
  };
  void predict(Track& track, double seconds) const;
  void correct(Track& track, Point2 seen) const;

  PeopleTrackerParams params_;
  std::vector<Track> tracks_;
  std::uint32_t next_id_ = 1;
  Time time_{};
};

}  // namespace docent
