#include "docent/task_control/tour_scheduler/tour_scheduler.h"

#include <algorithm>
#include <utility>

#include "docent/base/check.h"
#include "docent/task_control/tour_scheduler/route.h"

namespace docent {
namespace {

template <class T>
bool holds(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

std::string joined(const std::vector<TourStop>& stops) {
  std::string text;
  for (const TourStop& stop : stops) text += (text.empty() ? "" : " ") + stop.exhibit_id;
  return text;
}

bool is_place_of(const ProgrammeExhibit& exhibit, const Pose2& pose) {
  return is_same(exhibit.pose, pose) || std::any_of(exhibit.viewpoints.begin(), exhibit.viewpoints.end(),
                                                    [&](const Pose2& viewpoint) { return is_same(viewpoint, pose); });
}

}  // namespace

TourScheduler::TourScheduler(const SchedulerParams& params, Programme programme, TravelDistance travel,
                             SchedulerState state, Time now)
    : params_{params}, programme_{std::move(programme)}, travel_{std::move(travel)}, state_{std::move(state)} {
  DOCENT_CHECK(!programme_.languages.empty());
  drop_what_is_gone(now);
}

void TourScheduler::drop_what_is_gone(Time now) {
  std::vector<std::string> gone;
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    const bool is_known = request.kind == "tour" ? programme_.find_tour(request.target) != nullptr
                                                 : programme_.find_exhibit(request.target) != nullptr;
    if (docent::is_open(entry.status) && !is_known) gone.push_back(request.id);
  }
  for (const std::string& id : gone) close_request(id, RequestStatus::failed, "The museum no longer has this.", now);
  if (state_.visit) {
    const ProgrammeExhibit* exhibit = programme_.find_exhibit(state_.visit->exhibit_id);
    if (exhibit == nullptr) {
      state_.visit.reset();
    } else if (!is_place_of(*exhibit, state_.visit->map_from_base)) {  // it was moved, or the map is another
      state_.visit->map_from_base = exhibit->pose;
    }
  }
  if (!state_.tour) return;
  std::erase_if(state_.tour->stops,
                [&](const TourStop& stop) { return programme_.find_exhibit(stop.exhibit_id) == nullptr; });
  if (ids("tour", RequestStatus::active, state_.tour->tour_id).empty()) {
    state_.tour.reset();
    if (state_.visit) state_.visit->tour_id.clear();
  }
  end_tour_if_over(now);
  // What is called active but belongs to nothing under way waits again.
  std::vector<std::string> orphans;
  for (const BoardEntry& entry : state_.board.entries()) {
    const VisitorRequest& request = entry.request;
    const bool is_served = request.kind == "tour" ? state_.tour && state_.tour->tour_id == request.target
                                                  : state_.visit && state_.visit->exhibit_id == request.target;
    if (entry.status == RequestStatus::active && !is_served) orphans.push_back(request.id);
  }
  for (const std::string& id : orphans) state_.board.change(id, RequestStatus::queued, "", now);
}

std::string TourScheduler::refusal(const VisitorRequest& request, const Conditions& conditions) const {
  if (request.kind == "exhibit") {
    const ProgrammeExhibit* exhibit = programme_.find_exhibit(request.target);
    if (exhibit == nullptr) return "There is no exhibit '" + request.target + "' here.";
    if (exhibit->web_only && request.source != "web") return "This one is shown to Web visitors only.";
    if (request.viewpoint >= static_cast<int>(exhibit->viewpoints.size())) return "There is no such viewpoint.";
  } else if (request.kind == "tour") {
    if (programme_.find_tour(request.target) == nullptr) return "There is no tour '" + request.target + "' here.";
  } else {
    return "I do not understand the wish '" + request.kind + "'.";
  }
  const bool is_staff = request.source == "staff";
  if ((!conditions.is_open || conditions.mode == "closed") && !is_staff) return "The museum is closed.";
  if (conditions.mode == "web" && request.source != "web" && !is_staff) return "Just now only Web visitors guide me.";
  if (conditions.battery_low) return "My battery is low, I have to rest.";
  if (state_.board.open_count() >= static_cast<std::size_t>(params_.max_open))
    return "Too many people are waiting already. Please try again later.";
  return "";
}

void TourScheduler::submit(VisitorRequest request, const Conditions& conditions, Time now) {
  if (request.id.empty() || state_.board.find(request.id) != nullptr) return;
  if (!holds(programme_.languages, request.language)) request.language = programme_.languages.front();
  if (request.kind == "cancel") {
    cancel(request, now);
    return;
  }
  const std::string why_not = refusal(request, conditions);
  const std::string id = request.id;
  if (!why_not.empty()) {
    state_.board.add(std::move(request), RequestStatus::refused, why_not, now);
    happenings_.push_back({"request_refused", id, why_not});
    return;
  }
  const bool joins = may_join(request);
  happenings_.push_back({"request_queued", id, request.target, static_cast<double>(state_.board.open_count() + 1)});
  state_.board.add(std::move(request), RequestStatus::queued, "", now);
  if (joins) {
    state_.board.change(id, RequestStatus::active, "I am on my way there already.", now);
    happenings_.push_back({"request_active", id, state_.board.find(id)->request.target});
  }
}

bool TourScheduler::may_join(const VisitorRequest& request) const {
  if (!state_.visit || !state_.visit->is_joinable) return false;
  if (request.kind == "exhibit") return state_.visit->exhibit_id == request.target;
  if (!state_.tour || state_.tour->tour_id != request.target || state_.visit->tour_id != request.target) return false;
  return std::none_of(state_.tour->stops.begin(), state_.tour->stops.end(),
                      [](const TourStop& stop) { return stop.status != StopStatus::pending; });
}

void TourScheduler::cancel(const VisitorRequest& request, Time now) {
  const BoardEntry* target = state_.board.find(request.target);
  if (target == nullptr || !docent::is_open(target->status)) {
    const std::string why_not = "There is no such open request.";
    state_.board.add(request, RequestStatus::refused, why_not, now);
    happenings_.push_back({"request_refused", request.id, why_not});
    return;
  }
  close_request(request.target, RequestStatus::cancelled, "Cancelled.", now);
  state_.board.add(request, RequestStatus::queued, "", now);
  state_.board.change(request.id, RequestStatus::active, "", now);
  state_.board.change(request.id, RequestStatus::fulfilled, "", now);
  if (state_.tour && ids("tour", RequestStatus::active, state_.tour->tour_id).empty()) {
    happenings_.push_back({"tour_cancelled", state_.tour->tour_id, joined(state_.tour->stops)});
    state_.tour.reset();
    if (state_.visit) state_.visit->tour_id.clear();
  }
}

void TourScheduler::close_request(const std::string& id, RequestStatus status, const std::string& reason, Time now) {
  const Time created = state_.board.find(id)->created;
  state_.board.change(id, status, reason, now);
  if (status == RequestStatus::fulfilled) ++state_.counters.requests_served;
  happenings_.push_back({std::string{"request_"} + to_text(status), id, reason, to_seconds(now - created)});
}

std::vector<std::string> TourScheduler::ids(const std::string& kind, RequestStatus status,
                                            const std::string& target) const {
  std::vector<std::string> found;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status == status && entry.request.kind == kind && entry.request.target == target)
      found.push_back(entry.request.id);
  }
  return found;
}

void TourScheduler::close_visit() {
  if (state_.visit) state_.visit->is_joinable = false;
}

void TourScheduler::finish_visit(bool is_success, const std::string& reason, Time now) {
  DOCENT_CHECK(state_.visit.has_value());
  const Visit visit = *state_.visit;
  state_.visit.reset();
  if (is_success) {
    ++state_.counters.exhibits_explained;
    happenings_.push_back({"explained", visit.exhibit_id, visit.tour_id, to_seconds(now - visit.started)});
  } else {
    happenings_.push_back({"visit_failed", visit.exhibit_id, reason, to_seconds(now - visit.started)});
  }
  for (const std::string& id : ids("exhibit", RequestStatus::active, visit.exhibit_id)) {
    if (is_success) {
      close_request(id, RequestStatus::fulfilled, "", now);
      continue;
    }
    state_.board.count_attempt(id, now + seconds(params_.retry_after(state_.board.find(id)->attempts + 1)));
    if (state_.board.find(id)->attempts >= params_.max_attempts) {
      close_request(id, RequestStatus::failed, reason, now);
    } else {
      state_.board.change(id, RequestStatus::queued, reason + " I will try again.", now);
      happenings_.push_back({"plan_rescheduled", visit.exhibit_id, reason});
    }
  }
  if (state_.tour && visit.tour_id == state_.tour->tour_id) finish_stop(visit.exhibit_id, is_success);
  end_tour_if_over(now);
}

void TourScheduler::finish_stop(const std::string& exhibit_id, bool is_success) {
  auto& stops = state_.tour->stops;
  const auto stop = std::find_if(stops.begin(), stops.end(), [&](const TourStop& s) {
    return s.exhibit_id == exhibit_id && s.status == StopStatus::pending;
  });
  if (stop == stops.end()) return;
  if (is_success) {
    stop->status = StopStatus::explained;
    return;
  }
  ++stop->attempts;
  if (stop->attempts >= params_.max_stop_attempts) {
    stop->status = StopStatus::skipped;
    happenings_.push_back({"plan_removed", exhibit_id, state_.tour->tour_id});
  } else {
    happenings_.push_back({"plan_rescheduled", exhibit_id, state_.tour->tour_id});
    std::rotate(stop, stop + 1, stops.end());
  }
}

void TourScheduler::end_tour_if_over(Time now) {
  if (!state_.tour) return;
  const TourRun tour = *state_.tour;
  int explained = 0;
  int skipped = 0;
  std::string missed;
  for (const TourStop& stop : tour.stops) {
    if (stop.status == StopStatus::pending) return;
    if (stop.status == StopStatus::explained) {
      ++explained;
    } else {
      ++skipped;
      missed += (missed.empty() ? "" : ", ") + stop.exhibit_id;
    }
  }
  state_.tour.reset();
  // A composed tour shows something else instead.
  const bool is_success = explained > 0 && (tour.target_s > 0.0 || skipped <= params_.max_skipped);
  const std::string reason = skipped == 0 ? "" : "I could not get to: " + missed + ".";
  for (const std::string& id : ids("tour", RequestStatus::active, tour.tour_id)) {
    close_request(id, is_success ? RequestStatus::fulfilled : RequestStatus::failed, reason, now);
  }
  if (is_success) ++state_.counters.tours_completed;
  happenings_.push_back(
      {is_success ? "tour_completed" : "tour_failed", tour.tour_id, reason, to_seconds(now - tour.started)});
}

bool TourScheduler::is_in_a_hurry(Time now) const {
  const auto& entries = state_.board.entries();
  return std::any_of(entries.begin(), entries.end(), [&](const BoardEntry& entry) {
    return entry.status == RequestStatus::queued && now - entry.created > seconds(params_.hurry_after_s);
  });
}

bool TourScheduler::is_visit_unwanted() const {
  return state_.visit && state_.visit->tour_id.empty() &&
         ids("exhibit", RequestStatus::active, state_.visit->exhibit_id).empty();
}

void TourScheduler::drop_visit(Time now) {
  DOCENT_CHECK(is_visit_unwanted());
  happenings_.push_back(
      {"visit_dropped", state_.visit->exhibit_id, "nobody waits for it", to_seconds(now - state_.visit->started)});
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
  for (const std::string& exhibit : single_order(robot, now)) {
    if (!holds(list, exhibit)) list.push_back(exhibit);
  }
  std::vector<std::string> tours;
  for (const BoardEntry& entry : state_.board.entries()) {
    if (entry.status != RequestStatus::queued || entry.request.kind != "tour") continue;
    if (holds(tours, entry.request.target)) continue;
    tours.push_back(entry.request.target);
    const ProgrammeTour* tour = programme_.find_tour(entry.request.target);
    if (tour != nullptr) list.insert(list.end(), tour->exhibits.begin(), tour->exhibits.end());
  }
  return list;
}

std::vector<Happening> TourScheduler::take_happenings() { return std::exchange(happenings_, {}); }

}  // namespace docent
