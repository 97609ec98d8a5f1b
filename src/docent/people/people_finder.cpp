#include "docent/people/people_finder.h"

namespace docent::people {
namespace {

constexpr double kOdometryReset = 2.0;  // [m] between two sweeps: odometry has begun anew
constexpr double kStands = 0.2;         // [m/s]
constexpr double kHalf = 0.5;
constexpr double kRatherThing = 1.0;       // [nat]
constexpr double kSurelyThing = 3.5;       // [nat] in spite of motion: a body fitted to a face slides along it
constexpr double kThingsSeenWithin = 6.0;  // [m]
constexpr double kSolid = 0.4;             // share of the beams towards a person that end there: legs leave a gap
constexpr double kForEver = 1e9;           // [s]

PeopleTrackerParams tracker_of(const PeopleFinderParams& params) {
  PeopleTrackerParams tracker = params.tracker;
  if (params.keeps_all) tracker.patience = tracker.patience_unclear = tracker.patience_hidden = kForEver;
  return tracker;
}

}  // namespace

Result<void> PeopleFinderParams::validate() const {
  for (const auto& valid :
       {sightings.validate(), tracker.validate(), things.validate(), breadth.validate(), groups.validate()})
    if (!valid) return valid;
  return {};
}

PeopleFinder::PeopleFinder(const PeopleFinderParams& params)
    : params_{params},
      tracker_{tracker_of(params)},
      things_{params.things},
      breadth_{params.breadth},
      grouping_{params.groups} {}

void PeopleFinder::update(const PeopleSweep& sweep, const std::optional<Pose2>& map_from_odom, Time time) {
  if (odom_from_base_ && distance(odom_from_base_->position(), sweep.odom_from_base.position()) > kOdometryReset) {
    tracker_.clear();
    memory_ = FreeMemory{};
  }
  odom_from_base_ = sweep.odom_from_base;
  const Sightlines sightlines{sweep.sweep, sweep.odom_from_base};
  memory_.add(sweep.sweep, sweep.origins, sweep.odom_from_base, time);
  tracker_.predict(time);
  std::vector<PersonSighting> sightings = find_people(sweep, memory_, tracker_.places(), params_.sightings);
  // Most beams pass: glass that now and then returns one, or dust.
  std::erase_if(sightings, [&](const PersonSighting& sighting) {
    return sightlines.share_on(sighting.position, sighting.radius) < kSolid;
  });
  tracker_.update(sightings, sightlines);
  learn_breadth(time);
  if (map_from_odom) watch_things(sightlines, *map_from_odom, sweep.odom_from_base, time);
  people_.clear();
  for (const PersonTrack& track : tracker_.tracks())
    if (is_person(track, map_from_odom)) people_.push_back(track.person);
  groups_ = grouping_.update(people_, time);
}

void PeopleFinder::watch_things(const Sightlines& sightlines, const Pose2& map_from_odom, const Pose2& odom_from_base,
                                Time time) {
  for (const PersonTrack& track : tracker_.tracks()) {
    if (!tracker_.is_confirmed(track) || !track.is_seen_now(time) || norm(track.person.velocity) > kStands) continue;
    things_.see(map_from_odom * track.person.position, track.is_alive(), time);
  }
  things_.forget(sightlines, inverse(map_from_odom), map_from_odom * odom_from_base.position(), kThingsSeenWithin,
                 time);
}

void PeopleFinder::learn_breadth(Time time) {
  for (const PersonTrack& track : tracker_.tracks())
    if (track.is_alive() && tracker_.is_confirmed(track) && track.is_seen_now(time))
      breadth_.learn(track.sightings, track.breadth);
}

bool PeopleFinder::is_person(const PersonTrack& track, const std::optional<Pose2>& map_from_odom) const {
  if (!tracker_.is_confirmed(track)) return false;
  if (params_.keeps_all) return true;
  // Even who was seen to move: where a thing stands, nobody stands, but tracks of those who pass may stay there.
  if (map_from_odom && things_.is_thing(*map_from_odom * track.person.position)) return false;
  if (track.thing_gain > (track.is_alive() ? kSurelyThing : kRatherThing)) return false;
  if (track.is_alive()) return true;
  // Hardly anybody here looks so broad, and things do.
  if (breadth_.is_broad(track.breadth) && params_.things.person_odds * breadth_.share() < 1.0) return false;
  return track.by_map > kHalf;
}

}  // namespace docent::people
