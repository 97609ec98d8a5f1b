#include "docent/task_control/tour_scheduler/tour_scheduler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "docent/base/check.h"
#include "docent/task_control/tour_scheduler/route.h"
#include "docent/task_control/tour_scheduler/stop_lists.h"

namespace docent::task_control {
namespace {

/// What became of the stops of a tour.
struct StopOutcome {
  int pending = 0;
  int explained = 0;
  int skipped = 0;
  int declined = 0;
  std::string missed;  ///< ids of exhibits, with spaces between them
  [[nodiscard]] Reason reason() const {
    if (skipped > 0) return {ReasonWord::not_reached, missed};
    if (is_declined()) return ReasonWord::cancelled;
    return explained > 0 ? Reason{} : ReasonWord::gone;
  }
  /// Its visitors wanted nothing of it.
  [[nodiscard]] bool is_declined() const { return declined > 0 && explained == 0 && skipped == 0; }
};

/// For one member, or (nullptr) for all: then what was shown in one round counts, though another left it out.
StopOutcome outcome_of(const TourRun& tour, const TourMember* member) {
  StopOutcome outcome;
  const auto concerns = [&](const TourStop& stop) {
    return member == nullptr || member->stops.empty() || holds(member->stops, stop.number);
  };
  const auto is_shown = [&](const std::string& exhibit) {
    return std::any_of(tour.stops.begin(), tour.stops.end(), [&](const TourStop& stop) {
      return stop.exhibit_id == exhibit && stop.status == StopStatus::explained && concerns(stop);
    });
  };
  for (const TourStop& stop : tour.stops) {
    if (!concerns(stop)) continue;
    if (stop.status == StopStatus::pending) ++outcome.pending;
    if (stop.status == StopStatus::explained) ++outcome.explained;
    if (stop.status == StopStatus::declined) ++outcome.declined;
    if (stop.status != StopStatus::skipped || is_shown(stop.exhibit_id)) continue;
    ++outcome.skipped;
    outcome.missed += (outcome.missed.empty() ? "" : " ") + stop.exhibit_id;
  }
  return outcome;
}

/// What is told of a request that has come to this end.
EventKind event_of(RequestStatus end) {
  switch (end) {
    case RequestStatus::fulfilled:
      return EventKind::request_fulfilled;
    case RequestStatus::cancelled:
      return EventKind::request_cancelled;
    default:
      return EventKind::request_failed;
  }
}

}  // namespace

TourScheduler::TourScheduler(const SchedulerParams& params, Programme programme, TravelDistance travel,
                             SchedulerState state, Time now)
    : params_{params},
      programme_{std::move(programme)},
      travel_{std::move(travel)},
      times_{params.travel_times},
      state_{std::move(state)} {
  DOCENT_CHECK(!programme_.languages.empty());
  drop_what_is_gone(now);
}

void TourScheduler::drop_what_is_gone(Time now) {
  keep_points();
  std::vector<std::string> gone;
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    const ProgrammeExhibit* exhibit = programme_.find_exhibit(request.target);
    const bool is_known = request.kind == RequestKind::tour
                              ? programme_.find_tour(request.target) != nullptr
                              : exhibit != nullptr && has_viewpoint(*exhibit, request.viewpoint);
    if (docent::is_open(entry.status) && !is_known) gone.push_back(request.id);
  }
  for (const std::string& id : gone) close_request(id, RequestStatus::failed, ReasonWord::gone, now);
  if (state_.visit) {
    const ProgrammeExhibit* exhibit = programme_.find_exhibit(state_.visit->exhibit_id);
    if (exhibit == nullptr) {
      state_.visit.reset();
    } else if (!exhibit->is_point) {  // it may have been moved, or the map is another
      if (!has_viewpoint(*exhibit, state_.visit->viewpoint)) state_.visit->viewpoint = -1;
      state_.visit->map_from_base = exhibit->place(state_.visit->viewpoint);
    }
  }
  if (state_.tour) {
    const auto members = ids(RequestKind::tour, RequestStatus::active, state_.tour->tour_id);
    std::erase_if(state_.tour->stops,
                  [&](const TourStop& stop) { return programme_.find_exhibit(stop.exhibit_id) == nullptr; });
    std::erase_if(state_.tour->members, [&](const TourMember& member) { return !holds(members, member.request_id); });
    cancel_tour_without_members();
    end_tour_if_over(now);
  }
  // What is called active but belongs to nothing under way waits again.
  std::vector<std::string> orphans;
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    const bool is_served = request.kind == RequestKind::tour
                               ? state_.tour && is_member(*state_.tour, request.id)
                               : state_.visit && state_.visit->exhibit_id == request.target;
    if (entry.status == RequestStatus::active && !is_served) orphans.push_back(request.id);
  }
  for (const std::string& id : orphans) state_.board.change(id, RequestStatus::queued, {}, now);
}

void TourScheduler::close_request(const std::string& id, RequestStatus status, const Reason& reason, Time now) {
  const Time created = state_.board.find(id)->created;
  state_.board.change(id, status, reason, now);
  if (status == RequestStatus::fulfilled) ++state_.counters.requests_served;
  if (is_place_wish(state_.board.find(id)->request)) keep_points();
  happenings_.push_back({event_of(status), id, reason.text(), to_seconds(now - created)});
}

std::vector<std::string> TourScheduler::ids(RequestKind kind, RequestStatus status, const std::string& target) const {
  std::vector<std::string> found;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status == status && entry.request.kind == kind && entry.request.target == target)
      found.push_back(entry.request.id);
  }
  return found;
}

std::vector<std::string> TourScheduler::ids_of_visit(RequestStatus status, const std::string& target) const {
  std::vector<std::string> found;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status == status && is_single(entry.request) && entry.request.target == target)
      found.push_back(entry.request.id);
  }
  return found;
}

void TourScheduler::close_visit() {
  if (state_.visit) state_.visit->is_joinable = false;
}

void TourScheduler::finish_visit(bool is_success, const Reason& reason, Time now) {
  DOCENT_CHECK(state_.visit.has_value());
  const Visit visit = *state_.visit;
  state_.visit.reset();
  if (is_success && visit.is_point) {
    happenings_.push_back({EventKind::point_reached, visit.exhibit_id, "", to_seconds(now - visit.started)});
  } else if (is_success) {
    ++state_.counters.exhibits_explained;
    happenings_.push_back({EventKind::explained, visit.exhibit_id, visit.tour_id, to_seconds(now - visit.started)});
  } else {
    happenings_.push_back({EventKind::visit_failed, visit.exhibit_id, reason.text(), to_seconds(now - visit.started)});
  }
  for (const std::string& id : ids_of_visit(RequestStatus::active, visit.exhibit_id)) {
    if (is_success) {
      close_request(id, RequestStatus::fulfilled, {}, now);
      continue;
    }
    try_again(id, reason, now + seconds(params_.retry_after(state_.board.find(id)->attempts + 1)), now);
  }
  if (state_.tour && visit.tour_id == state_.tour->tour_id) finish_stop(visit.exhibit_id, is_success);
  if (state_.tour && is_success)
    recompose(visit.map_from_base.position(), now, std::numeric_limits<double>::infinity());
  end_tour_if_over(now);
}

void TourScheduler::finish_farewell(Time now) {
  DOCENT_CHECK(state_.farewell.has_value());
  happenings_.push_back(
      {EventKind::farewell, state_.farewell->tour_id, "", to_seconds(now - state_.farewell->started)});
  state_.farewell.reset();
}

void TourScheduler::try_again(const std::string& id, const Reason& reason, Time not_before, Time now) {
  state_.board.count_attempt(id, not_before);
  if (state_.board.find(id)->attempts >= params_.max_attempts) {
    close_request(id, RequestStatus::failed, reason, now);
    return;
  }
  state_.board.change(id, RequestStatus::queued, reason, now);
  happenings_.push_back({EventKind::plan_rescheduled, state_.board.find(id)->request.target, reason.text()});
}

void TourScheduler::break_off(const Reason& reason, Time now) {
  if (state_.visit) {
    for (const std::string& id : ids_of_visit(RequestStatus::active, state_.visit->exhibit_id))
      try_again(id, reason, now, now);
    happenings_.push_back(
        {EventKind::visit_failed, state_.visit->exhibit_id, reason.text(), to_seconds(now - state_.visit->started)});
    state_.visit.reset();
  }
  if (state_.tour) {
    for (const TourMember& member : state_.tour->members) try_again(member.request_id, reason, now, now);
    happenings_.push_back(
        {EventKind::tour_broken_off, state_.tour->tour_id, reason.text(), to_seconds(now - state_.tour->started)});
    state_.tour->broken_off = now;
    state_.broken_tour = std::move(*state_.tour);
    state_.tour.reset();
  }
}

void TourScheduler::finish_stop(const std::string& exhibit_id, bool is_success) {
  auto& stops = state_.tour->stops;
  const auto stop = pending_stop(stops, exhibit_id, -1);
  if (stop == stops.end()) return;
  if (is_success) {
    stop->status = StopStatus::explained;
    return;
  }
  ++stop->attempts;
  if (stop->attempts >= params_.max_stop_attempts) {
    stop->status = StopStatus::skipped;
    happenings_.push_back({EventKind::plan_removed, exhibit_id, state_.tour->tour_id});
  } else {
    happenings_.push_back({EventKind::plan_rescheduled, exhibit_id, state_.tour->tour_id});
    std::rotate(stop, stop + 1, stops.end());
  }
}

void TourScheduler::end_tour_if_over(Time now) {
  if (!state_.tour) return;
  TourRun& tour = *state_.tour;
  const bool is_composed = tour.target_s > 0.0;
  // A composed tour shows something else instead of what it could not get to.
  const auto is_good = [&](const StopOutcome& outcome) {
    return outcome.explained > 0 && (is_composed || outcome.skipped <= params_.max_skipped);
  };
  std::vector<TourMember> others;
  for (TourMember& member : tour.members) {
    const StopOutcome outcome = outcome_of(tour, &member);
    if (outcome.pending > 0) {
      others.push_back(std::move(member));
    } else {
      const auto end = is_good(outcome)        ? RequestStatus::fulfilled
                       : outcome.is_declined() ? RequestStatus::cancelled
                                               : RequestStatus::failed;
      close_request(member.request_id, end, outcome.reason(), now);
    }
  }
  tour.members = std::move(others);
  if (!tour.members.empty()) return;
  const StopOutcome outcome = outcome_of(tour, nullptr);
  if (is_good(outcome)) ++state_.counters.tours_completed;
  const auto end = is_good(outcome)        ? EventKind::tour_completed
                   : outcome.is_declined() ? EventKind::tour_cancelled
                                           : EventKind::tour_failed;
  happenings_.push_back({end, tour.tour_id, outcome.reason().text(), to_seconds(now - tour.started)});
  if (outcome.explained > 0) state_.farewell = Farewell{tour.tour_id, tour.language, tour.started};
  if (state_.visit) state_.visit->tour_id.clear();
  state_.tour.reset();
}

bool TourScheduler::is_in_a_hurry(Time now) const {
  const auto& entries = state_.board.entries();
  return std::any_of(entries.begin(), entries.end(), [&](const BoardEntry& entry) {
    return entry.status == RequestStatus::queued && now - entry.created > seconds(params_.hurry_after_s);
  });
}

bool TourScheduler::is_visit_unwanted() const {
  return state_.visit && state_.visit->tour_id.empty() &&
         ids_of_visit(RequestStatus::active, state_.visit->exhibit_id).empty();
}

void TourScheduler::drop_visit(Time now) {
  DOCENT_CHECK(is_visit_unwanted());
  happenings_.push_back({EventKind::visit_dropped, state_.visit->exhibit_id, "nobody waits for it",
                         to_seconds(now - state_.visit->started)});
  state_.visit.reset();
}

std::vector<std::string> TourScheduler::agenda(Point2 robot, Time now) const {
  std::vector<std::string> list;
  if (state_.tour) {
    for (const TourStop& stop : state_.tour->stops) {
      const bool is_under_way =
          state_.visit && !state_.visit->tour_id.empty() && state_.visit->exhibit_id == stop.exhibit_id;
      if (stop.status == StopStatus::pending && !is_under_way) list.push_back(stop.exhibit_id);
    }
  }
  for (const WishedStop& stop : single_order(robot, now)) {
    if (!holds(list, stop.exhibit_id)) list.push_back(stop.exhibit_id);
  }
  std::vector<std::string> tours;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status != RequestStatus::queued || entry.request.kind != RequestKind::tour) continue;
    if (holds(tours, entry.request.target)) continue;
    tours.push_back(entry.request.target);
    if (state_.broken_tour && state_.broken_tour->tour_id == entry.request.target) {
      for (const TourStop& stop : state_.broken_tour->stops)
        if (stop.status == StopStatus::pending) list.push_back(stop.exhibit_id);
      continue;
    }
    const ProgrammeTour* tour = programme_.find_tour(entry.request.target);
    if (tour != nullptr) list.insert(list.end(), tour->exhibits.begin(), tour->exhibits.end());
  }
  return list;
}

std::vector<Happening> TourScheduler::take_happenings() { return std::exchange(happenings_, {}); }

}  // namespace docent::task_control
