#include "docent/people/people_tracker.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace docent::people {
namespace {

constexpr double kLongest = 2.0;        // [s] that a prediction reaches
constexpr double kSlowsDown = 0.8;      // [s] in which somebody unseen is thought to stop
constexpr double kShare = 0.15;         // of a new sighting in the running shares
constexpr double kShoulder = 0.38;      // [m] nobody stands nearer to another
constexpr double kSoonGone = 0.3;       // [s]
constexpr double kTwice = 0.25;         // [m] two tracks so near are one person
constexpr double kCome = 0.6;           // share
constexpr int kSoon = 12;               // sightings: later the floor beside something may seem to be what it stands on
constexpr int kAway = 4;                // sightings in a row: one may be of somebody who passes
constexpr double kSeemsToStand = 0.25;  // [m/s]
constexpr double kNewcomer = 0.15;      // [m] that a track must be nearer than a confirmed one
constexpr double kMostGain = 6.0;       // [nat] that one sighting says
constexpr double kRadiusShare = 0.1;
constexpr double kApart = 0.1;  // [m] beyond `beside`: who gets so far away is no leg

}  // namespace

Result<void> PeopleTrackerParams::validate() const {
  if (!(gate > 0.0)) return fail("tracker.gate must be > 0");
  if (!(acceleration > 0.0)) return fail("tracker.acceleration must be > 0");
  if (!(sighting_noise > 0.0)) return fail("tracker.sighting_noise must be > 0");
  if (!(sightings >= 1)) return fail("tracker.sightings must be >= 1");
  for (const double wait : {patience, patience_unclear, patience_hidden})
    if (!(wait > 0.0)) return fail("tracker.patience, patience_unclear and patience_hidden must be > 0");
  if (!(fastest > 0.0)) return fail("tracker.fastest must be > 0");
  if (!(step > 0.0)) return fail("tracker.step must be > 0");
  if (!(beside >= 0.0)) return fail("tracker.beside must be >= 0");
  if (!(beside_sightings >= 0)) return fail("tracker.beside_sightings must be >= 0");
  return {};
}

bool PersonTrack::is_alive() const { return moved || came; }

void PeopleTracker::predict(Time time) {
  seconds_ = std::clamp(to_seconds(time - time_), 0.0, kLongest);
  const double q = params_.acceleration * params_.acceleration;
  for (PersonTrack& track : tracks_) {
    if (track.seen < time_) track.person.velocity = std::exp(-seconds_ / kSlowsDown) * track.person.velocity;
    track.person.position = track.person.position + seconds_ * track.person.velocity;
    track.pp += seconds_ * (2.0 * track.pv + seconds_ * track.vv) + q * seconds_ * seconds_ * seconds_ / 3.0;
    track.pv += seconds_ * track.vv + q * seconds_ * seconds_ / 2.0;
    track.vv += q * seconds_;
  }
  if (time > time_) time_ = time;
}

void PeopleTracker::correct(PersonTrack& track, const PersonSighting& sighting) const {
  const double noise = params_.sighting_noise * params_.sighting_noise;
  const double gain_position = track.pp / (track.pp + noise);
  const double gain_velocity = track.pv / (track.pp + noise);
  const Point2 off = sighting.position - track.person.position;
  track.person.position = track.person.position + gain_position * off;
  track.person.velocity = track.person.velocity + gain_velocity * off;
  const double speed = norm(track.person.velocity);
  if (speed > params_.fastest) track.person.velocity = (params_.fastest / speed) * track.person.velocity;
  track.vv -= gain_velocity * track.pv;
  track.pv -= gain_position * track.pv;
  track.pp -= gain_position * track.pp;

  ++track.sightings;
  track.seen = time_;
  track.missed = 0.0;
  track.come += kShare * ((sighting.has_come ? 1.0 : 0.0) - track.come);
  if (track.sightings >= params_.sightings && track.sightings <= kSoon && track.come > kCome) track.came = true;
  if (sighting.is_mapped) track.by_map += kShare * ((sighting.by_map ? 1.0 : 0.0) - track.by_map);
  track.thing_gain += kShare * (std::clamp(sighting.thing_gain, -kMostGain, kMostGain) - track.thing_gain);
  track.radius += kRadiusShare * (sighting.radius - track.radius);
  track.breadth += kRadiusShare * (sighting.breadth - track.breadth);
  // What slides along an unmapped face does not stand where the floor was free.
  const bool is_away = sighting.has_come && distance(track.person.position, track.anchor) > params_.step;
  track.away = is_away ? track.away + 1 : 0;
  if (track.away >= kAway) track.moved = true;
}

void PeopleTracker::miss(PersonTrack& track, const Sightlines& sightlines) const {
  double wait = params_.patience_unclear;
  switch (sightlines.look(track.person.position, track.radius)) {
    case Look::free:
      wait = params_.patience;
      break;
    case Look::hidden:
      // A person who walks comes out on the other side soon, or has gone elsewhere.
      wait = norm(track.person.velocity) > kSeemsToStand ? 0.5 * params_.patience_hidden : params_.patience_hidden;
      break;
    case Look::unclear:
      break;
  }
  // A person who was not confirmed yet is forgotten sooner.
  if (!is_confirmed(track)) wait = std::min(wait, 0.3 * params_.patience_unclear);
  track.missed += seconds_ / wait;
}

void PeopleTracker::begin(const PersonSighting& sighting) {
  PersonTrack track;
  track.person = {next_id_++, sighting.position, {}};
  track.pp = params_.sighting_noise * params_.sighting_noise;
  track.vv = 1.0;
  track.radius = sighting.radius;
  track.breadth = sighting.breadth;
  track.seen = time_;
  track.anchor = sighting.position;
  track.come = sighting.has_come ? 1.0 : 0.0;
  track.by_map = sighting.by_map ? 1.0 : 0.0;
  track.thing_gain = std::clamp(sighting.thing_gain, -kMostGain, kMostGain);
  const bool is_beside = std::any_of(tracks_.begin(), tracks_.end(), [&](const PersonTrack& other) {
    return is_confirmed(other) && distance(other.person.position, sighting.position) < params_.beside;
  });
  if (is_beside) track.doubts = params_.beside_sightings;
  tracks_.push_back(track);
}

void PeopleTracker::doubt_second_legs() {
  for (PersonTrack& track : tracks_) {
    if (track.doubts == 0 || !track.is_seen_now(time_)) continue;
    const PersonTrack* nearest = nullptr;
    double least = params_.beside + kApart;
    for (const PersonTrack& other : tracks_) {
      if (!is_confirmed(other)) continue;
      const double off = distance(other.person.position, track.person.position);
      if (off > least) continue;
      least = off;
      nearest = &other;
    }
    if (nearest == nullptr) {
      track.doubts = 0;
    } else if (nearest->is_seen_now(time_)) {
      --track.doubts;
    } else {
      track.doubts = params_.beside_sightings;  // the leg that was seen may be this one
    }
  }
}

void PeopleTracker::update(std::span<const PersonSighting> sightings, const Sightlines& sightlines) {
  // Nearest first, each track and each sighting once; those who are known before those who may be nobody.
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const double handicap = is_confirmed(tracks_[t]) ? 0.0 : kNewcomer;
    for (std::size_t s = 0; s < sightings.size(); ++s)
      if (const double off = distance(tracks_[t].person.position, sightings[s].position); off <= params_.gate)
        pairs.emplace_back(off + handicap, t, s);
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> track_taken(tracks_.size(), false);
  std::vector<bool> sighting_taken(sightings.size(), false);
  for (const auto& [off, t, s] : pairs) {
    if (track_taken[t] || sighting_taken[s]) continue;
    track_taken[t] = sighting_taken[s] = true;
    correct(tracks_[t], sightings[s]);
  }
  doubt_second_legs();
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (track_taken[t]) continue;
    miss(tracks_[t], sightlines);
    // Where somebody is seen, nobody else stands hidden.
    for (std::size_t other = 0; other < tracks_.size(); ++other)
      if (track_taken[other] && distance(tracks_[other].person.position, tracks_[t].person.position) < kShoulder) {
        tracks_[t].missed += seconds_ / kSoonGone;
        break;
      }
  }
  // The elder of two that came together stays.
  for (std::size_t t = 1; t < tracks_.size(); ++t)
    for (std::size_t elder = 0; elder < t; ++elder)
      if (tracks_[elder].missed < 1.0 && !track_taken[t] &&
          distance(tracks_[elder].person.position, tracks_[t].person.position) < kTwice)
        tracks_[t].missed = 1.0;
  std::erase_if(tracks_, [](const PersonTrack& track) { return track.missed >= 1.0; });
  for (std::size_t s = 0; s < sightings.size(); ++s)
    if (!sighting_taken[s]) begin(sightings[s]);
}

std::vector<Point2> PeopleTracker::places() const {
  std::vector<Point2> result;
  for (const PersonTrack& track : tracks_)
    if (is_confirmed(track)) result.push_back(track.person.position);
  return result;
}

}  // namespace docent::people
