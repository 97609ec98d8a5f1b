#include "docent/evaluation/request_tally.h"

namespace docent::evaluation {
namespace {

constexpr double kInPlace = 1.0;        ///< [m] from the place where the robot should stand
constexpr double kStillInTime = 600.0;  ///< [s] a wish may be open so long

}  // namespace

bool RequestTally::is_in_place(const std::string& exhibit, const std::optional<Point2>& truth) const {
  const auto place = places_.find(exhibit);
  return place == places_.end() || !truth || distance(place->second, *truth) <= kInPlace;
}

void RequestTally::add_offer(Time time, const docent_msgs::TrueOffer& offer) {
  if (offer.kind == "request") wishes_.try_emplace(offer.subject).first->second.offered = time;
}

void RequestTally::add_task(const docent_msgs::Task& task) {
  // The plan controller visits an exhibit; a GOLOG program drives to it and explains it then.
  const bool leads_there = parse<TaskKind>(task.kind) == TaskKind::visit ||
                           parse<TaskKind>(task.kind) == TaskKind::point || task.kind == "drive";
  if (leads_there) places_[task.exhibit_id] = {task.x, task.y};
}

void RequestTally::add_board(Time time, const docent_msgs::RequestBoard& board, const std::optional<Point2>& truth) {
  for (const auto& entry : board.requests) {
    const docent_msgs::Request& request = entry.request;
    const auto kind = parse<RequestKind>(request.kind);
    if (kind == RequestKind::cancel) continue;
    const auto [place, is_new] = wishes_.try_emplace(request.id);
    Wish& wish = place->second;
    if (is_new) wish.offered = time;
    const auto status = parse<RequestStatus>(entry.state);
    const bool is_change = wish.state != status;
    wish.on_board = true;
    wish.state = status;
    wish.reason = entry.reason;
    wish.source = parse<RequestSource>(request.source);
    wish.visitor = request.visitor;
    if (is_change && status == RequestStatus::fulfilled && kind != RequestKind::tour)
      wish.in_wrong_place = !is_in_place(request.target, truth);
  }
}

void RequestTally::add_event(Time time, const docent_msgs::Event& event, const std::optional<Point2>& truth) {
  const auto kind = parse<EventKind>(event.kind);
  if (!kind) return;
  switch (*kind) {
    case EventKind::explained:
      ++(is_in_place(event.subject, truth) ? tally_.exhibits_explained : tally_.explained_in_wrong_place);
      break;
    case EventKind::tour_started:
      ++tally_.tours.given;
      if (event.value > 0.0) tally_.tours.target_s.add(event.value);
      tours_under_way_[event.subject] = time;
      break;
    case EventKind::tour_completed:
      ++tally_.tours.completed;
      if (const auto tour = tours_under_way_.find(event.subject); tour != tours_under_way_.end())
        tally_.tours.seconds.add(to_seconds(time - tour->second));
      tours_under_way_.erase(event.subject);
      break;
    case EventKind::tour_failed:
    case EventKind::tour_cancelled:
      tours_under_way_.erase(event.subject);
      break;
    case EventKind::plan_inserted:
      ++tally_.plan_revisions.inserted;
      break;
    case EventKind::plan_removed:
      ++tally_.plan_revisions.removed;
      break;
    case EventKind::plan_rescheduled:
      ++tally_.plan_revisions.rescheduled;
      break;
    case EventKind::attraction_trial:
      ++tally_.attraction_trials;
      break;
    default:
      break;
  }
}

void RequestTally::fill(DeploymentReport& report, Time end) const {
  report.tours = tally_.tours;
  report.exhibits_explained = tally_.exhibits_explained;
  report.explained_in_wrong_place = tally_.explained_in_wrong_place;
  report.plan_revisions = tally_.plan_revisions;
  report.attraction_trials = tally_.attraction_trials;
  DeploymentReport::Requests& requests = report.requests;
  requests = {};
  std::set<std::string> web_visitors;
  int hall = 0;
  for (const auto& [id, wish] : wishes_) {
    ++requests.offered;
    if (wish.source == RequestSource::web) {
      web_visitors.insert(wish.visitor);
    } else {
      ++hall;
    }
    const bool is_served = wish.state == RequestStatus::fulfilled && !wish.in_wrong_place;
    if (wish.state != RequestStatus::cancelled && to_seconds(end - wish.offered) > kStillInTime) {
      ++requests.counted;
      requests.counted_served += is_served ? 1 : 0;
    }
    if (is_served) {
      ++requests.fulfilled;
    } else if (wish.state == RequestStatus::fulfilled) {
      ++requests.in_wrong_place;
      ++requests.failed;
    } else if (wish.state == RequestStatus::refused) {
      ++requests.refused[wish.reason];
    } else if (wish.state == RequestStatus::failed) {
      ++requests.failed;
    } else if (wish.state == RequestStatus::cancelled) {
      ++requests.cancelled;
    } else {
      ++requests.open;
      requests.never_seen += wish.on_board ? 0 : 1;
    }
  }
  report.visitors = hall;
  report.web_visitors = static_cast<int>(web_visitors.size());
  report.success_rate.reset();
  if (requests.counted > 0) report.success_rate = static_cast<double>(requests.counted_served) / requests.counted;
}

}  // namespace docent::evaluation
