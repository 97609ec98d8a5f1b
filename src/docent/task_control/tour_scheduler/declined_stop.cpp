// The part of TourScheduler that leaves out a stop which its visitors do not want.
#include <algorithm>
#include <limits>

#include "docent/task_control/tour_scheduler/stop_lists.h"
#include "docent/task_control/tour_scheduler/tour_scheduler.h"

namespace docent::task_control {

bool TourScheduler::decline_stop(const VisitorRequest& skip, Time now) {
  const bool is_under_way =
      state_.tour && state_.visit && !state_.visit->tour_id.empty() && state_.visit->exhibit_id == skip.target;
  if (!is_under_way) return false;
  TourRun& tour = *state_.tour;
  const auto may_decline = [&](const TourMember& member) {
    const auto& source = state_.board.find(member.request_id)->request.source;
    return skip.source == RequestSource::staff || (skip.source == RequestSource::kiosk && source == skip.source);
  };
  if (std::none_of(tour.members.begin(), tour.members.end(), may_decline)) return false;
  const auto stop = pending_stop(tour.stops, skip.target, -1);
  if (stop == tour.stops.end()) return false;
  happenings_.push_back(
      {EventKind::visit_dropped, skip.target, "its visitors go on", to_seconds(now - state_.visit->started)});
  for (const std::string& id : ids_of_visit(RequestStatus::active, skip.target))
    state_.board.change(id, RequestStatus::queued, {}, now);
  state_.visit.reset();
  tour.just_inserted = true;  // the next visit is a stop, not the same exhibit for somebody else
  // A composed tour shows something else instead, to all.
  const bool is_for_all = tour.target_s > 0.0 || std::all_of(tour.members.begin(), tour.members.end(), may_decline);
  if (is_for_all) {
    stop->status = StopStatus::declined;
    happenings_.push_back({EventKind::plan_removed, skip.target, tour.tour_id});
    recompose(programme_.find_exhibit(skip.target)->pose.position(), now, std::numeric_limits<double>::infinity());
  } else {
    for (TourMember& member : tour.members)
      if (may_decline(member)) std::erase(member.stops, stop->number);
    std::rotate(stop, stop + 1, tour.stops.end());
    happenings_.push_back({EventKind::plan_rescheduled, skip.target, tour.tour_id});
    drop_members_without_stops(now);
  }
  end_tour_if_over(now);
  return true;
}

void TourScheduler::drop_members_without_stops(Time now) {
  std::vector<std::string> gone;
  for (const TourMember& member : state_.tour->members)
    if (member.stops.empty()) gone.push_back(member.request_id);
  for (const std::string& id : gone) close_request(id, RequestStatus::cancelled, ReasonWord::cancelled, now);
  std::erase_if(state_.tour->members, [&](const TourMember& member) { return holds(gone, member.request_id); });
}

}  // namespace docent::task_control
