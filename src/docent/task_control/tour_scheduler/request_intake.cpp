// The part of TourScheduler that takes requests, refuses them, and lets them join what is under way.
#include <algorithm>
#include <cmath>
#include <utility>

#include "docent/task_control/tour_scheduler/stop_lists.h"
#include "docent/task_control/tour_scheduler/tour_scheduler.h"

namespace docent::task_control {

void TourScheduler::keep_points() {
  std::erase_if(programme_.exhibits, [](const ProgrammeExhibit& exhibit) { return exhibit.is_point; });
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    if (!is_place_wish(request) || !docent::is_open(entry.status)) continue;
    const auto place = place_of_wish(request);
    if (!place || programme_.find_exhibit(request.target) != nullptr) continue;
    ProgrammeExhibit& point = programme_.exhibits.emplace_back();
    point.id = request.target;
    const auto wish = request.kind == RequestKind::point ? point_of(request.target) : std::nullopt;
    point.pose = {place->x, place->y, wish && wish->heading ? *wish->heading : Angle{}};
    point.speech_s = 0.0;
    point.is_point = true;
  }
}

std::optional<Point2> TourScheduler::place_of_wish(const VisitorRequest& request) const {
  if (request.kind == RequestKind::point) {
    const auto wish = point_of(request.target);
    return wish ? std::optional{wish->place} : std::nullopt;
  }
  const ProgrammeRoom* room = programme_.rooms ? programme_.rooms().find(request.target) : nullptr;
  return room != nullptr ? std::optional{room->place} : std::nullopt;
}

void TourScheduler::name_place(VisitorRequest& request, Point2 robot) const {
  if (request.kind == RequestKind::point) {
    if (const auto wish = point_of(request.target)) request.target = point_name(*wish);
  } else if (request.target == kNextRoom && programme_.rooms) {
    Point2 from = robot;
    Time latest{};
    for (const BoardEntry& entry : state_.board.entries()) {
      if (entry.request.kind != RequestKind::room || !docent::is_open(entry.status) || entry.created < latest) continue;
      latest = entry.created;
      from = place_of_wish(entry.request).value_or(from);
    }
    if (const ProgrammeRoom* room = programme_.rooms().after(from)) request.target = room->id;
  }
}

Reason TourScheduler::refusal_of_place(const VisitorRequest& request, const Conditions& conditions) const {
  if (!conditions.takes_points) return {ReasonWord::not_understood, request.kind.text()};
  const auto place = place_of_wish(request);
  const bool is_room = request.kind == RequestKind::room;
  if (!place)
    return is_room ? Reason{ReasonWord::no_such_room, request.target}
                   : Reason{ReasonWord::not_understood, request.kind.text()};
  // Whoever is in the hall goes there with the robot; to others it belongs in their hours only.
  const bool is_there = request.source == RequestSource::staff || (is_room && request.source != RequestSource::web);
  if (conditions.mode != OperatingMode::web && !is_there) return ReasonWord::only_in_web_hours;
  const auto points = std::count_if(programme_.exhibits.begin(), programme_.exhibits.end(),
                                    [](const ProgrammeExhibit& exhibit) { return exhibit.is_point; });
  if (programme_.find_exhibit(request.target) == nullptr && points >= params_.max_points)
    return ReasonWord::too_many_points;
  if (programme_.has_room && !programme_.has_room(*place)) return ReasonWord::not_on_free_floor;
  if (!std::isfinite(travel_(programme_.home.position(), *place))) return ReasonWord::not_on_free_floor;
  return {};
}

Reason TourScheduler::refusal(const VisitorRequest& request, const Conditions& conditions) const {
  if (request.kind == RequestKind::exhibit) {
    const ProgrammeExhibit* exhibit = programme_.find_exhibit(request.target);
    if (exhibit == nullptr) return {ReasonWord::no_such_exhibit, request.target};
    if (exhibit->web_only && request.source != RequestSource::web) return ReasonWord::for_web_only;
    if (!has_viewpoint(*exhibit, request.viewpoint)) return ReasonWord::no_such_viewpoint;
  } else if (request.kind == RequestKind::tour) {
    if (programme_.find_tour(request.target) == nullptr) return {ReasonWord::no_such_tour, request.target};
  } else if (!is_place_wish(request)) {
    return {ReasonWord::not_understood, request.kind.text()};
  }
  const bool is_staff = request.source == RequestSource::staff;
  if ((!conditions.is_open || conditions.mode == OperatingMode::closed) && !is_staff) return ReasonWord::closed;
  if (conditions.mode == OperatingMode::web && request.source != RequestSource::web &&
      request.source != RequestSource::vote && !is_staff)
    return ReasonWord::web_only_now;
  if (is_place_wish(request)) {
    if (Reason why_not = refusal_of_place(request, conditions); !why_not.is_none()) return why_not;
  }
  if (state_.board.open_count() >= static_cast<std::size_t>(params_.max_open) ||
      state_.board.stops_with(request) > static_cast<std::size_t>(params_.max_stops))
    return ReasonWord::too_many_wait;
  return {};
}

void TourScheduler::submit(VisitorRequest request, const Conditions& conditions, Time now) {
  if (request.id.empty() || state_.board.find(request.id) != nullptr) return;
  if (!holds(programme_.languages, request.language)) request.language = programme_.languages.front();
  request.viewpoint = std::max(request.viewpoint, -1);
  if (request.kind == RequestKind::cancel) {
    cancel(request, now);
    return;
  }
  name_place(request, conditions.robot);
  const Reason why_not = refusal(request, conditions);
  const std::string id = request.id;
  if (!why_not.is_none()) {
    state_.board.add(std::move(request), RequestStatus::refused, why_not, now);
    happenings_.push_back({EventKind::request_refused, id, why_not.text()});
    return;
  }
  const bool joins = join(request);
  happenings_.push_back(
      {EventKind::request_queued, id, request.target, static_cast<double>(state_.board.open_count() + 1)});
  const bool is_late = joins && request.kind == RequestKind::tour && !is_at_its_beginning();
  note_load(request, now);
  state_.board.add(std::move(request), RequestStatus::queued, joins ? Reason{} : conditions.delay, now);
  if (joins) {
    state_.board.change(id, RequestStatus::active, is_late ? ReasonWord::joins_tour : ReasonWord::on_the_way, now);
    happenings_.push_back({EventKind::request_active, id, state_.board.find(id)->request.target});
  }
  keep_points();
}

bool TourScheduler::join(const VisitorRequest& request) {
  if (request.kind == RequestKind::tour) return join_tour(request);
  return state_.visit && state_.visit->is_joinable && state_.visit->exhibit_id == request.target &&
         (request.viewpoint < 0 || request.viewpoint == state_.visit->viewpoint);
}

bool TourScheduler::is_at_its_beginning() const {
  const bool is_speaking = state_.visit && !state_.visit->tour_id.empty() && !state_.visit->is_joinable;
  return !is_speaking && std::none_of(state_.tour->stops.begin(), state_.tour->stops.end(),
                                      [](const TourStop& stop) { return stop.status != StopStatus::pending; });
}

bool TourScheduler::join_tour(const VisitorRequest& request) {
  if (!state_.tour || state_.tour->tour_id != request.target) return false;
  TourRun& tour = *state_.tour;
  if (tour.target_s > 0.0) {
    if (!is_at_its_beginning()) return false;
    tour.members.push_back({request.id, {}});
    return true;
  }
  const auto& exhibits = programme_.find_tour(tour.tour_id)->exhibits;
  const auto is_first_round = [&](const TourStop& stop) {
    return stop.status == StopStatus::pending && stop.number < static_cast<int>(exhibits.size());
  };
  if (std::none_of(tour.stops.begin(), tour.stops.end(), is_first_round)) return false;
  // The stop that is being explained is over for whoever comes now.
  const auto spoken_of = state_.visit && !state_.visit->tour_id.empty() && !state_.visit->is_joinable
                             ? pending_stop(tour.stops, state_.visit->exhibit_id, -1)
                             : tour.stops.end();
  const int over = spoken_of == tour.stops.end() ? -1 : spoken_of->number;
  TourMember member{request.id, {}};
  for (const std::string& exhibit : exhibits) {
    if (programme_.find_exhibit(exhibit) == nullptr) continue;
    const auto stop = pending_stop(tour.stops, exhibit, over);
    if (stop != tour.stops.end()) {
      member.stops.push_back(stop->number);
      continue;
    }
    int number = 0;
    for (const TourStop& other : tour.stops) number = std::max(number, other.number + 1);
    number = std::max(number, static_cast<int>(exhibits.size()));
    tour.stops.push_back({exhibit, StopStatus::pending, 0, number});
    member.stops.push_back(number);
    happenings_.push_back({EventKind::plan_inserted, exhibit, tour.tour_id});
  }
  tour.members.push_back(std::move(member));
  return true;
}

void TourScheduler::cancel(const VisitorRequest& request, Time now) {
  const BoardEntry* target = state_.board.find(request.target);
  if (target == nullptr || !docent::is_open(target->status)) {
    const Reason why_not = ReasonWord::no_such_request;
    state_.board.add(request, RequestStatus::refused, why_not, now);
    happenings_.push_back({EventKind::request_refused, request.id, why_not.text()});
    return;
  }
  close_request(request.target, RequestStatus::cancelled, ReasonWord::cancelled, now);
  state_.board.add(request, RequestStatus::queued, {}, now);
  state_.board.change(request.id, RequestStatus::active, {}, now);
  state_.board.change(request.id, RequestStatus::fulfilled, {}, now);
  if (!state_.tour || !is_member(*state_.tour, request.target)) return;
  std::erase_if(state_.tour->members, [&](const TourMember& member) { return member.request_id == request.target; });
  cancel_tour_without_members();
}

void TourScheduler::cancel_tour_without_members() {
  if (!state_.tour->members.empty()) return;
  happenings_.push_back(
      {EventKind::tour_cancelled, state_.tour->tour_id, joined(state_.tour->stops, &TourStop::exhibit_id)});
  state_.tour.reset();
  if (state_.visit) state_.visit->tour_id.clear();
}

}  // namespace docent::task_control
