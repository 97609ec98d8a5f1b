#include "docent/evaluation/run_logs/people_log.h"

#include <cstdio>

#include "docent/base/files.h"
#include "docent/evaluation/people_match.h"
#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr const char* kPeopleColumns =
    "time,frame,localized,robot_speed,robot_turn,kind,id,away,beams,in_view_s,speed,radius,track,off,track_speed,x,y\n";
constexpr Duration kEvery = std::chrono::milliseconds{500};
constexpr std::size_t kMostPeopleWaiting = 200;

double speed_of(const docent_msgs::Person& person) {
  return norm({static_cast<double>(person.vx), static_cast<double>(person.vy)});
}

}  // namespace

void PeopleLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kPeople.name || name == topics::kPeopleInOdom.name) {
    waiting_.push_back({name == topics::kPeople.name, std::static_pointer_cast<const docent_msgs::People>(message)});
    if (waiting_.size() > kMostPeopleWaiting) waiting_.pop_front();
  } else if (name == topics::kTrueState.name) {
    add_truth(time, std::static_pointer_cast<const docent_msgs::TrueState>(message));
  }
}

void PeopleLog::add_truth(Time time, std::shared_ptr<const docent_msgs::TrueState> state) {
  if (truth_.empty()) first_ = time;
  std::map<std::uint32_t, Time> in_view;
  for (std::size_t p = 0; p < state->people.size(); ++p) {
    const auto& person = state->people[p];
    if (beams_on(*state, p) < kVisibleBeams ||
        distance(Point2{state->x, state->y}, {person.x, person.y}) > kJudgedRange)
      continue;
    const auto before = in_view_.find(person.id);
    in_view[person.id] = before == in_view_.end() ? time : before->second;
  }
  in_view_ = std::move(in_view);
  truth_.add(std::move(state));
  while (!waiting_.empty() && from_message(waiting_.front().people->header.stamp) <= truth_.latest_time()) {
    const Waiting claim = waiting_.front();
    waiting_.pop_front();
    const Time stamp = from_message(claim.people->header.stamp);
    const auto sampled = sampled_.find(claim.in_map);
    if (sampled != sampled_.end() && stamp - sampled->second < kEvery) continue;
    const auto* then = truth_.state_at(stamp);
    if (then == nullptr) continue;
    sampled_[claim.in_map] = stamp;
    judge(claim, *then, stamp);
  }
}

void PeopleLog::judge(const Waiting& claim, const docent_msgs::TrueState& truth, Time stamp) {
  const docent_msgs::People& people = *claim.people;
  const auto& place = people.frame_from_base;
  const Pose2 world_from_frame =
      claim.in_map ? Pose2{} : true_pose(truth) * inverse(Pose2{place[0], place[1], Angle::radians(place[2])});
  const Point2 robot{truth.x, truth.y};
  std::vector<Point2> tracks;
  for (const auto& person : people.people)
    tracks.push_back(world_from_frame * Point2{static_cast<double>(person.x), static_cast<double>(person.y)});
  const PeopleMatch match = match_people(truth, tracks);
  char begin[120];
  std::snprintf(begin, sizeof begin, "%.2f,%s,%d,%.3f,%.3f", to_seconds(stamp - first_), claim.in_map ? "map" : "odom",
                people.localized ? 1 : 0, truth.linear, truth.angular);
  char line[400];
  const auto append = [&](int size) {
    lines_.append(line, static_cast<std::size_t>(size));
    ++rows_;
  };
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    const auto& person = truth.people[p];
    const Point2 at{person.x, person.y};
    if (distance(robot, at) > kJudgedRange) continue;
    const auto seen = in_view_.find(person.id);
    const docent_msgs::Person* track = match.track_of[p] ? &people.people[*match.track_of[p]] : nullptr;
    append(std::snprintf(line, sizeof line, "%s,person,%u,%.3f,%d,%.2f,%.3f,%.3f,%u,%.3f,%.3f,%.3f,%.3f\n", begin,
                         person.id, distance(robot, at), beams_on(truth, p),
                         seen == in_view_.end() ? 0.0 : std::max(0.0, to_seconds(stamp - seen->second)),
                         norm({static_cast<double>(person.vx), static_cast<double>(person.vy)}),
                         static_cast<double>(person.radius), track ? track->id : 0U,
                         track ? distance(at, tracks[*match.track_of[p]]) : -1.0, track ? speed_of(*track) : 0.0, at.x,
                         at.y));
  }
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    if (distance(robot, tracks[t]) > kJudgedRange || match.person_of[t]) continue;
    const auto& track = people.people[t];
    append(std::snprintf(line, sizeof line, "%s,nobody,%u,%.3f,0,0.00,%.3f,0.000,%u,-1.000,%.3f,%.3f,%.3f\n", begin,
                         track.id, distance(robot, tracks[t]), speed_of(track), track.id, speed_of(track), tracks[t].x,
                         tracks[t].y));
  }
}

Result<void> PeopleLog::save(const std::string& path) const {
  return write_file_atomically(path, kPeopleColumns + lines_);
}

}  // namespace docent::evaluation
