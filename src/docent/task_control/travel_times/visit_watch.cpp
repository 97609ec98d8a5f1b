#include "docent/task_control/travel_times/visit_watch.h"

#include <utility>

namespace docent::task_control {

void VisitWatch::set_out(std::string from, std::string to, double way_m, Time now) {
  step_ = Step::driving;
  was_asked_ = false;
  way_ = {std::move(from), std::move(to), way_m, 0.0};
  set_out_ = now;
}

VisitWatch::Seen VisitWatch::report(TaskStatus status, Time now) {
  Seen seen;
  if (step_ == Step::none) return seen;
  const bool arrives = step_ == Step::driving && (status == TaskStatus::explaining || status == TaskStatus::done);
  if (arrives) {
    way_.seconds = to_seconds(now - set_out_);
    seen.way = way_;
    arrived_ = now;
    step_ = Step::explaining;
  } else if (status == TaskStatus::asking) {
    was_asked_ = true;
    step_ = Step::asking;
  } else if (status == TaskStatus::explaining && step_ == Step::asking) {
    step_ = Step::explaining_more;
  } else if (status == TaskStatus::done) {
    const VisitCourse course = step_ == Step::explaining_more ? VisitCourse::heard_more
                               : was_asked_                   ? VisitCourse::went_on
                                                              : VisitCourse::unasked;
    seen.visit = MadeVisit{course, to_seconds(now - arrived_)};
  }
  if (status == TaskStatus::done || status == TaskStatus::failed) step_ = Step::none;
  return seen;
}

}  // namespace docent::task_control
