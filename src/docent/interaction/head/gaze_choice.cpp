#include "docent/interaction/head/gaze_choice.h"

#include <algorithm>
#include <cmath>

namespace docent::interaction {
namespace {

Angle bearing_of(Point2 place) { return direction({}, place); }

}  // namespace

Result<void> GazeChoiceParams::validate() const {
  if (!(in_way > 0.0)) return fail("gaze.in_way must be > 0");
  if (!(way_reach > 0.0)) return fail("gaze.way_reach must be > 0");
  if (!(standing > 0.0)) return fail("gaze.standing must be > 0");
  if (!(company > 0.0)) return fail("gaze.company must be > 0");
  if (!(loyalty >= 0.0)) return fail("gaze.loyalty must be >= 0");
  if (!(turn_s > 0.0)) return fail("gaze.turn_s must be > 0");
  for (const double height : {eyes, faces, exhibit, on_floor})
    if (!(height > 0.0 && height < 3.0)) return fail("gaze: eyes, faces, exhibit and on_floor must be > 0 and < 3 m");
  if (!(nearest > 0.0)) return fail("gaze.nearest must be > 0");
  return {};
}

LookFor GazeChoice::look_of(const HeadView& view) {
  if (view.task == TaskKind::relocalize && view.status == TaskStatus::driving) return LookFor::nobody;
  switch (view.status.value_or(TaskStatus::done)) {
    case TaskStatus::driving:
      return view.look.value_or(view.task == TaskKind::visit ? LookFor::place : LookFor::way);
    case TaskStatus::explaining:
    case TaskStatus::asking:
      return view.look.value_or(LookFor::visitors);
    case TaskStatus::done:
    case TaskStatus::failed:
      break;
  }
  return LookFor::company;
}

GazeTarget GazeChoice::choose(const HeadView& view, Time now) {
  if (view.pointed && !view.is_blocked) {
    last_person_ = 0;
    return {LookAt::goal, 0, bearing_of(*view.pointed).radians(), tilt_to(*view.pointed, params_.on_floor)};
  }
  const LookFor look = look_of(view);
  const bool is_driving = view.status == TaskStatus::driving && look != LookFor::nobody;
  const SeenPerson* person = nullptr;
  LookAt at = LookAt::visitor;
  if (is_driving || view.is_blocked) {
    person = in_the_way(view);
    at = LookAt::person;
  } else if (look == LookFor::visitors) {
    person = company(view, GazeStrategy::nearest, now);
  } else if (look == LookFor::company) {
    person = company(view, view.company, now);
  }
  if (person != nullptr) {
    if (person->id != last_person_) since_ = now;
    last_person_ = person->id;
    return at_person(*person, at);
  }
  last_person_ = 0;
  return at_things(view, look);
}

GazeTarget GazeChoice::at_things(const HeadView& view, LookFor look) const {
  if (view.is_blocked && view.wanted) return {LookAt::way, 0, view.wanted->radians(), 0.0};
  const bool shows = view.exhibit && (look == LookFor::place || look == LookFor::visitors);
  if (shows) return {LookAt::goal, 0, bearing_of(*view.exhibit).radians(), tilt_to(*view.exhibit, params_.exhibit)};
  const bool has_way = view.wanted && (look == LookFor::place || look == LookFor::way);
  return has_way ? GazeTarget{LookAt::way, 0, view.wanted->radians(), 0.0} : GazeTarget{};
}

const SeenPerson* GazeChoice::in_the_way(const HeadView& view) const {
  if (!view.wanted) return nullptr;
  const Point2 ahead = unit(*view.wanted);
  const SeenPerson* nearest = nullptr;
  for (const SeenPerson& person : view.people) {
    const double along = dot(ahead, person.position);
    const bool stands_there = along > 0.0 && along < params_.way_reach &&
                              std::abs(cross(ahead, person.position)) < params_.in_way &&
                              norm(person.velocity) < params_.standing;
    if (stands_there && (nearest == nullptr || along < dot(ahead, nearest->position))) nearest = &person;
  }
  return nearest;
}

const SeenPerson* GazeChoice::company(const HeadView& view, GazeStrategy strategy, Time now) {
  if (strategy == GazeStrategy::ahead) return nullptr;
  const SeenPerson* nearest = nullptr;
  const SeenPerson* last = nullptr;
  for (const SeenPerson& person : view.people) {
    if (norm(person.position) > params_.company) continue;
    if (person.id == last_person_) last = &person;
    if (nearest == nullptr || norm(person.position) < norm(nearest->position)) nearest = &person;
  }
  if (last == nullptr) return nearest;
  if (strategy == GazeStrategy::everybody) return now - since_ < seconds(params_.turn_s) ? last : next_of(view.people);
  return norm(nearest->position) < norm(last->position) - params_.loyalty ? nearest : last;
}

/// By their ids, in a circle.
const SeenPerson* GazeChoice::next_of(std::span<const SeenPerson> people) const {
  const SeenPerson* first = nullptr;
  const SeenPerson* next = nullptr;
  for (const SeenPerson& person : people) {
    if (norm(person.position) > params_.company) continue;
    if (first == nullptr || person.id < first->id) first = &person;
    if (person.id > last_person_ && (next == nullptr || person.id < next->id)) next = &person;
  }
  return next != nullptr ? next : first;
}

GazeTarget GazeChoice::at_person(const SeenPerson& person, LookAt at) const {
  return {at, person.id, bearing_of(person.position).radians(), tilt_to(person.position, params_.faces)};
}

double GazeChoice::tilt_to(Point2 place, double height) const {
  return std::atan2(height - params_.eyes, std::max(norm(place), params_.nearest));
}

}  // namespace docent::interaction
