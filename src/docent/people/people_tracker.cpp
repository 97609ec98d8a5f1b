#include "docent/people/people_tracker.h"

#include <algorithm>
#include <tuple>

namespace docent {

Result<void> PeopleTrackerParams::validate() const {
  if (!(gate > 0.0)) return fail("tracker.gate must be > 0");
  if (!(acceleration > 0.0)) return fail("tracker.acceleration must be > 0");
  if (!(sighting_noise > 0.0)) return fail("tracker.sighting_noise must be > 0");
  if (!(sightings >= 1)) return fail("tracker.sightings must be >= 1");
  if (!(patience > 0.0)) return fail("tracker.patience must be > 0");
  if (!(fastest > 0.0)) return fail("tracker.fastest must be > 0");
  return {};
}

void PeopleTracker::predict(Track& track, double seconds) const {
  track.person.position = track.person.position + seconds * track.person.velocity;
  const double q = params_.acceleration * params_.acceleration;
  track.pp += seconds * (2.0 * track.pv + seconds * track.vv) + q * seconds * seconds * seconds / 3.0;
  track.pv += seconds * track.vv + q * seconds * seconds / 2.0;
  track.vv += q * seconds;
}

void PeopleTracker::correct(Track& track, Point2 seen) const {
  const double noise = params_.sighting_noise * params_.sighting_noise;
  const double gain_position = track.pp / (track.pp + noise);
  const double gain_velocity = track.pv / (track.pp + noise);
  const Point2 off = seen - track.person.position;
  track.person.position = track.person.position + gain_position * off;
  track.person.velocity = track.person.velocity + gain_velocity * off;
  const double speed = norm(track.person.velocity);
  if (speed > params_.fastest) track.person.velocity = (params_.fastest / speed) * track.person.velocity;
  track.vv -= gain_velocity * track.pv;
  track.pv -= gain_position * track.pv;
  track.pp -= gain_position * track.pp;
}

void PeopleTracker::update(std::span<const PersonSighting> sightings, Time time) {
  const double seconds = std::max(0.0, to_seconds(time - time_));
  if (time > time_) time_ = time;
  for (Track& track : tracks_) predict(track, std::min(seconds, 2.0));

  // Nearest first, each track and each sighting once.
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t s = 0; s < sightings.size(); ++s)
      if (const double off = distance(tracks_[t].person.position, sightings[s].position); off <= params_.gate)
        pairs.emplace_back(off, t, s);
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> track_taken(tracks_.size(), false);
  std::vector<bool> sighting_taken(sightings.size(), false);
  for (const auto& [off, t, s] : pairs) {
    if (track_taken[t] || sighting_taken[s]) continue;
    track_taken[t] = sighting_taken[s] = true;
    correct(tracks_[t], sightings[s].position);
    ++tracks_[t].sightings;
    tracks_[t].seen = time_;
  }
  // Who was not confirmed yet is forgotten sooner.
  std::erase_if(tracks_, [this](const Track& track) {
    const double patience = track.sightings >= params_.sightings ? params_.patience : 0.3 * params_.patience;
    return to_seconds(time_ - track.seen) > patience;
  });
  for (std::size_t s = 0; s < sightings.size(); ++s) {
    if (sighting_taken[s]) continue;
    Track track;
    track.person = {next_id_++, sightings[s].position, {}};
    track.pp = params_.sighting_noise * params_.sighting_noise;
    track.vv = 1.0;
    track.seen = time_;
    tracks_.push_back(track);
  }
}

std::vector<TrackedPerson> PeopleTracker::people() const {
  std::vector<TrackedPerson> result;
  for (const Track& track : tracks_)
    if (track.sightings >= params_.sightings) result.push_back(track.person);
  return result;
}

}  // namespace docent
