#include "docent/evaluation/people_score.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "docent/messages/conversions.h"

namespace docent {
namespace {

constexpr double kRange = 5.0;  ///< [m]
constexpr double kMatch = 0.6;  ///< [m]
constexpr std::size_t kMostWaiting = 100;

}  // namespace

void PeopleScore::add(const docent_msgs::People& people, bool is_localized) {
  if (!is_localized) return;
  waiting_.push_back(people);
  if (waiting_.size() > kMostWaiting) waiting_.pop_front();
}

void PeopleScore::step(const TruthHistory& truth) {
  while (!waiting_.empty() && from_message(waiting_.front().header.stamp) <= truth.latest_time()) {
    if (const auto* state = truth.state_at(from_message(waiting_.front().header.stamp)))
      judge(waiting_.front(), *state);
    waiting_.pop_front();
  }
}

void PeopleScore::judge(const docent_msgs::People& people, const docent_msgs::TrueState& truth) {
  const Point2 robot{truth.x, truth.y};
  struct Pair {
    double away;
    std::size_t person, track;
  };
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    const Point2 person{truth.people[p].x, truth.people[p].y};
    if (distance(robot, person) > kRange + kMatch) continue;
    for (std::size_t t = 0; t < people.people.size(); ++t) {
      const double away = distance(person, {people.people[t].x, people.people[t].y});
      if (away <= kMatch) pairs.push_back({away, p, t});
    }
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tie(a.away, a.person, a.track) < std::tie(b.away, b.person, b.track);
  });
  std::vector<bool> person_found(truth.people.size());
  std::vector<bool> track_right(people.people.size());
  for (const Pair& pair : pairs) {
    if (person_found[pair.person] || track_right[pair.track]) continue;
    person_found[pair.person] = track_right[pair.track] = true;
  }
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    const auto& person = truth.people[p];
    if (!person.visible || distance(robot, {person.x, person.y}) > kRange) continue;
    ++result_.present;
    result_.found += person_found[p] ? 1 : 0;
  }
  for (std::size_t t = 0; t < people.people.size(); ++t) {
    if (distance(robot, {people.people[t].x, people.people[t].y}) > kRange) continue;
    ++result_.claimed;
    result_.right += track_right[t] ? 1 : 0;
  }
}

}  // namespace docent
