// The half of TourScheduler that chooses what comes next.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "docent/base/check.h"
#include "docent/task_control/tour_scheduler/route.h"
#include "docent/task_control/tour_scheduler/stop_lists.h"
#include "docent/task_control/tour_scheduler/tour_scheduler.h"

namespace docent::task_control {
namespace {

/// The stops that a member of a tour with a fixed order takes part in from its beginning.
std::vector<int> numbers_of(const TourRun& tour) {
  std::vector<int> numbers;
  if (tour.target_s > 0.0) return numbers;
  for (const TourStop& stop : tour.stops) numbers.push_back(stop.number);
  return numbers;
}

}  // namespace

bool TourScheduler::is_overdue(const BoardEntry& entry, Time now) const {
  const auto most = std::find_if(state_.loads.begin(), state_.loads.end(),
                                 [&](const Load& load) { return load.at >= entry.created; });
  const int stops = most == state_.loads.end() ? static_cast<int>(state_.board.stops_with(entry.request)) : most->stops;
  return now - entry.created > seconds(std::max(params_.overdue_s, params_.overdue_per_stop_s * stops));
}

void TourScheduler::note_load(const VisitorRequest& newest, Time now) {
  const int stops = static_cast<int>(state_.board.stops_with(newest));
  while (!state_.loads.empty() && state_.loads.back().stops <= stops) state_.loads.pop_back();
  state_.loads.push_back({now, stops});
}

const BoardEntry* TourScheduler::oldest_due(Time now) const {
  const BoardEntry* oldest = nullptr;
  const BoardEntry* voted = nullptr;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status != RequestStatus::queued || entry.not_before > now) continue;
    // Who sends the robot to a place, like a fleet manager, counts on it.
    if (entry.request.source == RequestSource::staff && is_place_wish(entry.request)) return &entry;
    if (entry.request.source == RequestSource::vote && voted == nullptr) voted = &entry;
    if (oldest == nullptr) oldest = &entry;
  }
  return voted != nullptr ? voted : oldest;
}

std::optional<std::string> TourScheduler::waiting_tour_to(const std::string& exhibit_id, Time now) const {
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status != RequestStatus::queued || entry.request.kind != RequestKind::tour || entry.not_before > now)
      continue;
    const ProgrammeTour* tour = programme_.find_tour(entry.request.target);
    if (tour != nullptr && holds(tour->exhibits, exhibit_id)) return tour->id;
  }
  return std::nullopt;
}

WishedStop TourScheduler::stop_at(const std::string& exhibit_id, Time now) const {
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    if (entry.status == RequestStatus::queued && request.kind == RequestKind::exhibit && request.target == exhibit_id &&
        request.viewpoint >= 0 && entry.not_before <= now)
      return {exhibit_id, request.viewpoint};
  }
  return {exhibit_id};
}

Point2 TourScheduler::place_of(const WishedStop& stop) const {
  return programme_.find_exhibit(stop.exhibit_id)->place(stop.viewpoint).position();
}

std::vector<WishedStop> TourScheduler::ways_to_meet(const WishedStop& stop) const {
  std::vector<WishedStop> ways{stop};
  if (stop.viewpoint >= 0) return ways;
  // After a visit that failed the exhibit's own place is the surest.
  for (const std::string& id : ids(RequestKind::exhibit, RequestStatus::queued, stop.exhibit_id)) {
    if (state_.board.find(id)->attempts > 0) return ways;
  }
  const int viewpoints = static_cast<int>(programme_.find_exhibit(stop.exhibit_id)->viewpoints.size());
  for (int viewpoint = 0; viewpoint < viewpoints; ++viewpoint) ways.push_back({stop.exhibit_id, viewpoint});
  return ways;
}

std::vector<WishedStop> TourScheduler::single_order(Point2 robot, Time now) const {
  std::vector<WishedStop> overdue;
  std::vector<WishedStop> others;
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    if (entry.status != RequestStatus::queued || request.kind != RequestKind::exhibit || entry.not_before > now)
      continue;
    if (programme_.find_exhibit(request.target) == nullptr) continue;
    // A request that minds no viewpoint takes part in the first stop that is made there.
    const WishedStop stop =
        request.viewpoint < 0 ? stop_at(request.target, now) : WishedStop{request.target, request.viewpoint};
    if (holds(overdue, stop)) continue;
    if (is_overdue(entry, now) || !params_.by_travel) {
      overdue.push_back(stop);
    } else if (!holds(others, stop)) {
      others.push_back(stop);
    }
  }
  std::erase_if(others, [&](const WishedStop& stop) { return holds(overdue, stop); });
  if (!params_.by_travel) return overdue;
  std::vector<WishedStop> order;
  for (const auto* stops : {&overdue, &others}) append_shortest(*stops, robot, order);
  return order;
}

void TourScheduler::append_shortest(const std::vector<WishedStop>& stops, Point2 robot,
                                    std::vector<WishedStop>& order) const {
  std::vector<std::vector<WishedStop>> choices;
  std::vector<StopPlaces> places;
  for (const WishedStop& stop : stops) {
    choices.push_back(ways_to_meet(stop));
    StopPlaces& list = places.emplace_back();
    for (const WishedStop& choice : choices.back()) list.push_back(place_of(choice));
  }
  const Point2 start = order.empty() ? robot : place_of(order.back());
  for (const RouteStop& next : shortest_route(start, places, travel_)) order.push_back(choices[next.stop][next.place]);
}

std::optional<WishedStop> TourScheduler::stop_to_insert(Point2 robot, Time now) const {
  const TourRun& tour = *state_.tour;
  const auto next = std::find_if(tour.stops.begin(), tour.stops.end(),
                                 [](const TourStop& stop) { return stop.status == StopStatus::pending; });
  if (tour.just_inserted || next == tour.stops.end()) return std::nullopt;
  const Point2 goal = programme_.find_exhibit(next->exhibit_id)->pose.position();
  const double direct = travel_(robot, goal);
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status != RequestStatus::queued || entry.request.kind != RequestKind::exhibit || entry.not_before > now)
      continue;
    const ProgrammeExhibit* exhibit = programme_.find_exhibit(entry.request.target);
    if (exhibit == nullptr) continue;
    const bool is_a_stop = std::any_of(tour.stops.begin(), tour.stops.end(), [&](const TourStop& stop) {
      return stop.exhibit_id == exhibit->id && stop.status == StopStatus::pending;
    });
    if (is_a_stop) continue;  // the tour comes by anyway
    const WishedStop stop =
        entry.request.viewpoint < 0 ? stop_at(exhibit->id, now) : WishedStop{exhibit->id, entry.request.viewpoint};
    const Point2 place = place_of(stop);
    const bool may_detour = !(tour.target_s > 0.0);  // a composed tour has its time
    if (is_overdue(entry, now) ||
        (may_detour && travel_(robot, place) + travel_(place, goal) - direct <= params_.max_detour_m))
      return stop;
  }
  return std::nullopt;
}

const std::optional<Visit>& TourScheduler::begin_visit(Point2 robot, Time now, double budget_s) {
  DOCENT_CHECK(!state_.visit);
  // A tour may turn out to be over, or to have nothing to show: then the next request has its turn.
  while (!state_.visit && !state_.farewell) {
    if (state_.tour) {
      begin_stop(robot, now, budget_s);
      continue;
    }
    const BoardEntry* oldest = oldest_due(now);
    if (oldest == nullptr) break;
    if (oldest->request.kind == RequestKind::tour) {
      if (!begin_tour(std::string{oldest->request.target}, robot, now, budget_s)) break;
      continue;
    }
    const std::vector<WishedStop> order =
        is_place_wish(oldest->request) ? std::vector<WishedStop>{{oldest->request.target}} : single_order(robot, now);
    const WishedStop& next = order.front();
    if (const auto tour = waiting_tour_to(next.exhibit_id, now)) {
      if (!begin_tour(*tour, robot, now, budget_s)) break;
      continue;
    }
    const ProgrammeExhibit& exhibit = *programme_.find_exhibit(next.exhibit_id);
    if (exceeds(stop_duration_of(exhibit, programme_.languages.front(), robot, place_of(next), now), budget_s)) break;
    happenings_.push_back({EventKind::order_chosen, next.exhibit_id, joined(order, place_name)});
    const Point2 way = place_of(next) - robot;
    begin_visit_of(next, false, now);
    const auto wish = point_of(next.exhibit_id);
    if (state_.visit->is_point && !(wish && wish->heading))
      state_.visit->map_from_base.theta = Angle::radians(std::atan2(way.y, way.x));
  }
  return state_.visit;
}

std::vector<std::string> TourScheduler::choices(Point2 robot, Time now) {
  if (state_.visit || state_.farewell) return {};
  if (state_.tour) {
    recompose(robot, now, std::numeric_limits<double>::infinity());
    end_tour_if_over(now);
  }
  if (state_.tour) {
    for (const TourStop& stop : state_.tour->stops) {
      if (stop.status == StopStatus::pending) return {stop.exhibit_id};
    }
  }
  const BoardEntry* oldest = oldest_due(now);
  if (oldest == nullptr || state_.farewell) return {};
  std::vector<std::string> exhibits;
  if (oldest->request.kind == RequestKind::tour) {
    if (const ProgrammeTour* tour = programme_.find_tour(oldest->request.target)) exhibits = tour->exhibits;
    if (state_.broken_tour && state_.broken_tour->tour_id == oldest->request.target &&
        is_member(*state_.broken_tour, oldest->request.id)) {
      exhibits.clear();
      for (const TourStop& stop : state_.broken_tour->stops)
        if (stop.status == StopStatus::pending) exhibits.push_back(stop.exhibit_id);
    }
    if (exhibits.empty()) exhibits = first_stops(oldest->request, robot, now);
    std::erase_if(exhibits, [&](const std::string& id) { return programme_.find_exhibit(id) == nullptr; });
    exhibits.resize(std::min<std::size_t>(exhibits.size(), 1));
    return exhibits;
  }
  if (is_place_wish(oldest->request)) return {oldest->request.target};
  for (const WishedStop& stop : single_order(robot, now)) {
    if (!holds(exhibits, stop.exhibit_id)) exhibits.push_back(stop.exhibit_id);
  }
  return exhibits;
}

std::vector<std::string> TourScheduler::first_stops(const VisitorRequest& request, Point2 robot, Time now) const {
  const ProgrammeTour* tour = programme_.find_tour(request.target);
  if (tour == nullptr) return {};
  TourRun run{tour->id, request.language, {}, false, tour->target_s, now};
  return compose(run, robot, now, std::numeric_limits<double>::infinity()).stops;
}

bool TourScheduler::begin_visit_to(const std::string& exhibit_id, Point2 robot, Time now) {
  DOCENT_CHECK(!state_.visit);
  if (!holds(choices(robot, now), exhibit_id)) return false;
  const BoardEntry* oldest = oldest_due(now);
  if (!state_.tour && oldest->request.kind == RequestKind::tour &&
      (!begin_tour(std::string{oldest->request.target}, robot, now, std::numeric_limits<double>::infinity()) ||
       !state_.tour))
    return false;
  const bool is_stop =
      state_.tour && std::any_of(state_.tour->stops.begin(), state_.tour->stops.end(), [&](const TourStop& stop) {
        return stop.exhibit_id == exhibit_id && stop.status == StopStatus::pending;
      });
  begin_visit_of(stop_at(exhibit_id, now), is_stop, now);
  return true;
}

void TourScheduler::suspend_visit(Time now) {
  DOCENT_CHECK(state_.visit.has_value());
  for (const std::string& id : ids_of_visit(RequestStatus::active, state_.visit->exhibit_id))
    state_.board.change(id, RequestStatus::queued, {}, now);
  happenings_.push_back({EventKind::plan_rescheduled, state_.visit->exhibit_id, state_.visit->tour_id});
  state_.visit.reset();
}

void TourScheduler::shorten(Point2 robot, Time now, double budget_s) {
  TourRun& tour = *state_.tour;
  if (tour.target_s > 0.0) return;
  TourRun rest = tour;
  std::erase_if(rest.stops, [](const TourStop& stop) { return stop.status != StopStatus::pending; });
  auto skipped = std::count_if(tour.stops.begin(), tour.stops.end(),
                               [](const TourStop& stop) { return stop.status == StopStatus::skipped; });
  while (rest.stops.size() > 1 && skipped < params_.max_skipped && exceeds(duration_of(rest, robot, now), budget_s)) {
    const TourStop last = rest.stops.back();
    rest.stops.pop_back();
    std::find_if(tour.stops.begin(), tour.stops.end(), [&](const TourStop& stop) {
      return stop.number == last.number;
    })->status = StopStatus::skipped;
    ++skipped;
    happenings_.push_back({EventKind::plan_shortened, last.exhibit_id, tour.tour_id, budget_s});
  }
}

void TourScheduler::begin_stop(Point2 robot, Time now, double budget_s) {
  recompose(robot, now, budget_s);
  shorten(robot, now, budget_s);
  end_tour_if_over(now);
  if (!state_.tour) return;
  if (const auto extra = stop_to_insert(robot, now)) {
    happenings_.push_back({EventKind::plan_inserted, extra->exhibit_id, state_.tour->tour_id});
    state_.tour->just_inserted = true;
    begin_visit_of(*extra, false, now);
    return;
  }
  state_.tour->just_inserted = false;
  const auto next = std::find_if(state_.tour->stops.begin(), state_.tour->stops.end(),
                                 [](const TourStop& stop) { return stop.status == StopStatus::pending; });
  begin_visit_of(stop_at(next->exhibit_id, now), true, now);
}

TourPlan TourScheduler::compose(const TourRun& tour, Point2 robot, Time now, double budget_s) const {
  TourSoFar so_far{robot};
  for (const TourStop& stop : tour.stops) {
    if (stop.status == StopStatus::pending) continue;
    so_far.done.push_back(stop.exhibit_id);
    if (stop.status != StopStatus::explained) continue;
    so_far.after = stop.exhibit_id;
    ++so_far.explained;
  }
  so_far.left_s = std::min(tour.target_s - to_seconds(now - tour.started), budget_s);
  so_far.wished = wished_exhibits();
  so_far.language = tour.language;
  so_far.may_ask = params_.offer_more && !is_in_a_hurry(now);
  return plan_tour(programme_, so_far, travel_, times_, now, params_.composition);
}

void TourScheduler::recompose(Point2 robot, Time now, double budget_s) {
  TourRun& tour = *state_.tour;
  if (!(tour.target_s > 0.0) || (tour.composed_at == now && !std::isfinite(budget_s))) return;
  tour.composed_at = now;
  std::vector<TourStop> pending;
  std::vector<TourStop> stops;
  for (TourStop& stop : tour.stops) {
    // What failed once is not tried again in a tour that could show something else.
    if (stop.status == StopStatus::pending && stop.attempts > 0) {
      stop.status = StopStatus::skipped;
      happenings_.push_back({EventKind::plan_removed, stop.exhibit_id, tour.tour_id});
    }
    (stop.status == StopStatus::pending ? pending : stops).push_back(stop);
  }
  const TourPlan plan = compose(tour, robot, now, budget_s);
  const auto plans = [](const std::vector<TourStop>& list, const std::string& id) {
    return std::any_of(list.begin(), list.end(), [&](const TourStop& stop) { return stop.exhibit_id == id; });
  };
  for (const TourStop& stop : pending) {
    if (!holds(plan.stops, stop.exhibit_id))
      happenings_.push_back({EventKind::plan_removed, stop.exhibit_id, tour.tour_id});
  }
  for (const std::string& exhibit : plan.stops) {
    if (!plans(pending, exhibit)) happenings_.push_back({EventKind::plan_inserted, exhibit, tour.tour_id});
    stops.push_back({exhibit});
  }
  tour.stops = std::move(stops);
  tour.asks = plan.asks;
}

std::vector<std::string> TourScheduler::wished_exhibits() const {
  std::vector<std::string> wished;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status == RequestStatus::queued && entry.request.kind == RequestKind::exhibit)
      wished.push_back(entry.request.target);
  }
  return wished;
}

double TourScheduler::way_duration(Point2 from, Point2 to, Time now) const {
  return times_.way(place_at(programme_, from), place_at(programme_, to), travel_(from, to), now).mean_s;
}

double TourScheduler::stop_duration_of(const ProgrammeExhibit& exhibit, const std::string& language, Point2 from,
                                       Point2 to, Time now) const {
  return stop_duration(exhibit.length_in(language), way_duration(from, to, now), params_.offer_more, times_);
}

double TourScheduler::duration_of(const TourRun& tour, Point2 robot, Time now) const {
  if (tour.target_s > 0.0) return tour.target_s;
  double duration_s = 0.0;
  for (const TourStop& stop : tour.stops) {
    const ProgrammeExhibit& exhibit = *programme_.find_exhibit(stop.exhibit_id);
    duration_s += stop_duration_of(exhibit, tour.language, robot, exhibit.pose.position(), now);
    robot = exhibit.pose.position();
  }
  return duration_s;
}

bool TourScheduler::begin_tour(const std::string& tour_id, Point2 robot, Time now, double budget_s) {
  const auto members = ids(RequestKind::tour, RequestStatus::queued, tour_id);
  if (const auto resumed = resume_tour(tour_id, members, robot, now, budget_s)) return *resumed;
  const ProgrammeTour* tour = programme_.find_tour(tour_id);
  TourRun run{tour_id, state_.board.find(members.front())->request.language, {}, false, 0.0, now};
  if (tour != nullptr) {
    run.target_s = tour->target_s;
    if (run.target_s > 0.0 && exceeds(run.target_s, budget_s)) return false;  // before it is composed, which costs more
    auto exhibits = tour->exhibits;
    if (exhibits.empty()) {
      TourPlan plan = compose(run, robot, now, budget_s);
      run.asks = plan.asks;
      run.composed_at = now;
      exhibits = std::move(plan.stops);
    }
    for (const std::string& exhibit : exhibits) {
      if (programme_.find_exhibit(exhibit) == nullptr) continue;
      run.stops.push_back({exhibit, StopStatus::pending, 0, static_cast<int>(run.stops.size())});
    }
  }
  if (run.stops.empty()) {  // the museum changed while the request waited
    for (const std::string& id : members) close_request(id, RequestStatus::failed, ReasonWord::gone, now);
    return true;
  }
  if (exceeds(duration_of(run, robot, now), budget_s)) return false;
  const bool is_voted = std::any_of(members.begin(), members.end(), [&](const std::string& id) {
    return state_.board.find(id)->request.source == RequestSource::vote;
  });
  state_.counters.tours_since_vote = is_voted ? 0 : state_.counters.tours_since_vote + 1;
  for (const std::string& id : members) {
    run.members.push_back({id, numbers_of(run)});
    state_.board.change(id, RequestStatus::active, ReasonWord::tour_begun, now);
    happenings_.push_back({EventKind::request_active, id, tour_id});
  }
  happenings_.push_back({EventKind::tour_started, tour_id, joined(run.stops, &TourStop::exhibit_id), run.target_s});
  state_.tour = std::move(run);
  return true;
}

void TourScheduler::begin_visit_of(const WishedStop& stop, bool is_stop, Time now) {
  const std::string& exhibit_id = stop.exhibit_id;
  const ProgrammeExhibit& exhibit = *programme_.find_exhibit(exhibit_id);
  Visit visit{exhibit_id,
              stop.viewpoint,
              exhibit.place(stop.viewpoint),
              "",
              is_stop ? state_.tour->tour_id : "",
              true,
              now,
              !is_stop || state_.tour->asks,
              exhibit.is_point};
  auto members = ids_of_visit(RequestStatus::queued, exhibit_id);
  std::erase_if(members, [&](const std::string& id) {
    const int wished = state_.board.find(id)->request.viewpoint;
    return wished >= 0 && wished != stop.viewpoint;
  });
  for (const std::string& id : members) {
    if (visit.language.empty()) visit.language = state_.board.find(id)->request.language;
    state_.board.change(id, RequestStatus::active, {}, now);
    happenings_.push_back({EventKind::request_active, id, exhibit_id});
  }
  if (is_stop) visit.language = state_.tour->language;
  if (visit.language.empty()) visit.language = programme_.languages.front();
  happenings_.push_back({EventKind::visit_started, exhibit_id, visit.tour_id, static_cast<double>(members.size())});
  state_.visit = std::move(visit);
}

}  // namespace docent::task_control
