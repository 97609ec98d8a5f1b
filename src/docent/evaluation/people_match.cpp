#include "docent/evaluation/people_match.h"

#include <algorithm>
#include <tuple>

namespace docent::evaluation {

PeopleMatch match_people(const docent_msgs::TrueState& truth, std::span<const Point2> tracks) {
  PeopleMatch match;
  match.track_of.resize(truth.people.size());
  match.person_of.resize(tracks.size());
  struct Pair {
    double away;
    std::size_t person, track;
  };
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    const Point2 person{truth.people[p].x, truth.people[p].y};
    for (std::size_t t = 0; t < tracks.size(); ++t)
      if (const double away = distance(person, tracks[t]); away <= kMatchRange) pairs.push_back({away, p, t});
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.away, a.person, a.track) < std::tie(b.away, b.person, b.track);
  });
  for (const Pair& pair : pairs) {
    if (match.track_of[pair.person] || match.person_of[pair.track]) continue;
    match.track_of[pair.person] = pair.track;
    match.person_of[pair.track] = pair.person;
  }
  return match;
}

int beams_on(const docent_msgs::TrueState& truth, std::size_t person) {
  if (person < truth.person_beams.size()) return truth.person_beams[person];
  return truth.people[person].visible ? kVisibleBeams : 0;
}

}  // namespace docent::evaluation
