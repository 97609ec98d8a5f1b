#include "docent/evaluation/people_score.h"

#include <vector>

#include "docent/evaluation/people_match.h"
#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr std::size_t kMostSightings = 100;

}  // namespace

void PeopleScore::add(const docent_msgs::People& people) {
  if (!people.localized) return;
  waiting_.push_back(people);
  if (waiting_.size() > kMostSightings) waiting_.pop_front();
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
  std::vector<Point2> tracks;
  for (const auto& person : people.people) tracks.push_back({person.x, person.y});
  const PeopleMatch match = match_people(truth, tracks);
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    const auto& person = truth.people[p];
    if (beams_on(truth, p) < kVisibleBeams || distance(robot, {person.x, person.y}) > kJudgedRange) continue;
    ++result_.present;
    result_.found += match.track_of[p] ? 1 : 0;
  }
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (distance(robot, tracks[t]) > kJudgedRange) continue;
    ++result_.claimed;
    result_.right += match.person_of[t] ? 1 : 0;
  }
}

}  // namespace docent::evaluation
