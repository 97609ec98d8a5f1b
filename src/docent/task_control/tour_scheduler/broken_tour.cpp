// The part of TourScheduler that goes on with a tour which was broken off.
#include <algorithm>
#include <utility>

#include "docent/task_control/tour_scheduler/stop_lists.h"
#include "docent/task_control/tour_scheduler/tour_scheduler.h"

namespace docent::task_control {

void TourScheduler::let_go_broken_tour(Time now) {
  if (!state_.broken_tour || now - state_.broken_tour->broken_off < seconds(params_.wait_for_group_s)) return;
  std::vector<std::string> waiting;
  for (const TourMember& member : state_.broken_tour->members) {
    const BoardEntry* entry = state_.board.find(member.request_id);
    if (entry == nullptr || entry->status != RequestStatus::queued) continue;
    if (entry->request.source != RequestSource::kiosk && entry->request.source != RequestSource::visitor) return;
    waiting.push_back(member.request_id);
  }
  for (const std::string& id : waiting) close_request(id, RequestStatus::failed, state_.board.find(id)->reason, now);
  happenings_.push_back({EventKind::tour_cancelled, state_.broken_tour->tour_id, "its visitors have left"});
  state_.broken_tour.reset();
}

std::optional<bool> TourScheduler::resume_tour(const std::string& tour_id, const std::vector<std::string>& members,
                                               Point2 robot, Time now, double budget_s) {
  if (!state_.broken_tour || state_.broken_tour->tour_id != tour_id) return std::nullopt;
  TourRun rest = *state_.broken_tour;
  std::erase_if(rest.members, [&](const TourMember& member) { return !holds(members, member.request_id); });
  std::erase_if(rest.stops, [&](const TourStop& stop) { return programme_.find_exhibit(stop.exhibit_id) == nullptr; });
  TourRun ahead = rest;
  std::erase_if(ahead.stops, [](const TourStop& stop) { return stop.status != StopStatus::pending; });
  if (rest.members.empty() || ahead.stops.empty()) {
    state_.broken_tour.reset();
    return std::nullopt;
  }
  if (rest.target_s > 0.0) ahead.target_s -= to_seconds(rest.broken_off - rest.started);
  if (exceeds(duration_of(ahead, robot, now), budget_s)) return false;
  rest.started = rest.started + (now - rest.broken_off);  // meanwhile nobody was shown anything
  rest.broken_off = {};
  happenings_.push_back({EventKind::tour_started, tour_id, joined(ahead.stops, &TourStop::exhibit_id), ahead.target_s});
  state_.broken_tour.reset();
  state_.tour = std::move(rest);
  for (const std::string& id : members) {
    const bool was_there = is_member(*state_.tour, id);
    if (!was_there && !join_tour(state_.board.find(id)->request)) continue;  // they get a run of their own
    state_.board.change(id, RequestStatus::active, was_there ? ReasonWord::tour_begun : ReasonWord::joins_tour, now);
    happenings_.push_back({EventKind::request_active, id, tour_id});
  }
  return true;
}

}  // namespace docent::task_control
