#include "docent/planning/survey/walkers.h"

#include <utility>

namespace docent::planning {

void Walkers::note(std::span<const TrackedPerson> people) {
  constexpr double kWalked = 0.7;  // [m] from where somebody was seen first
  std::map<std::uint32_t, Track> tracks;
  places_.clear();
  for (const TrackedPerson& person : people) {
    const auto known = tracks_.find(person.id);
    Track track = known == tracks_.end() ? Track{person.place, false} : known->second;
    track.has_walked = track.has_walked || distance(track.first, person.place) > kWalked;
    if (track.has_walked) places_.push_back(person.place);
    tracks[person.id] = track;
  }
  tracks_ = std::move(tracks);
}

}  // namespace docent::planning
