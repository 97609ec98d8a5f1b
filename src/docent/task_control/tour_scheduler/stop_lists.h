#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "docent/task_control/tour_scheduler/tour_scheduler.h"

namespace docent::task_control {

// Lists of exhibits and stops, for the sources of this folder.

template <class T>
[[nodiscard]] bool holds(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// Their names with spaces between them. @param name_of  a member of a stop, or a function of it
template <class Stop, class NameOf>
[[nodiscard]] std::string joined(const std::vector<Stop>& stops, NameOf name_of) {
  std::string text;
  for (const Stop& stop : stops) text += (text.empty() ? "" : " ") + std::invoke(name_of, stop);
  return text;
}

[[nodiscard]] inline bool has_viewpoint(const ProgrammeExhibit& exhibit, int viewpoint) {
  return viewpoint < static_cast<int>(exhibit.viewpoints.size());
}

/// A point on the map or a room.
[[nodiscard]] inline bool is_place_wish(const VisitorRequest& request) {
  const auto kind = request.kind.value();
  return kind && is_place(*kind);
}

/// Whether a visit serves it, not a tour.
[[nodiscard]] inline bool is_single(const VisitorRequest& request) {
  return request.kind == RequestKind::exhibit || is_place_wish(request);
}

[[nodiscard]] inline bool is_member(const TourRun& tour, const std::string& request_id) {
  return std::any_of(tour.members.begin(), tour.members.end(),
                     [&](const TourMember& member) { return member.request_id == request_id; });
}

/// Foreseen to take longer than it may [s]. Where no way is known, trying tells.
[[nodiscard]] inline bool exceeds(double duration_s, double budget_s) {
  return std::isfinite(duration_s) && duration_s > budget_s;
}

/// The next stop at the exhibit, but not the one with the number `except`.
[[nodiscard]] inline std::vector<TourStop>::iterator pending_stop(std::vector<TourStop>& stops,
                                                                  const std::string& exhibit_id, int except) {
  return std::find_if(stops.begin(), stops.end(), [&](const TourStop& stop) {
    return stop.exhibit_id == exhibit_id && stop.status == StopStatus::pending && stop.number != except;
  });
}

}  // namespace docent::task_control
