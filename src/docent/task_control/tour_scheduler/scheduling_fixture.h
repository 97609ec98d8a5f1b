#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "docent/task_control/tour_scheduler/tour_scheduler.h"

// For tests of the scheduler.

namespace docent::task_control {

/// Six exhibits, 4 m apart on a line; the last for the Web alone.
inline Programme programme_on_a_line() {
  Programme programme;
  programme.languages = {"en", "de"};
  for (int i = 1; i <= 6; ++i) {
    programme.exhibits.push_back({"e" + std::to_string(i), {4.0 * i, 0, {}}, {}, 20.0, i == 6});
  }
  programme.exhibits[1].viewpoints = {{8, 1, {}}, {8, -1, {}}};
  programme.tours = {{"t", {"e1", "e3", "e5"}, 0.0}, {"two", {"e2", "e4"}, 0.0}, {"quick", {}, 120.0}};
  return programme;
}

class Scheduling : public testing::Test {
 protected:
  void wish(const std::string& id, RequestKind kind, const std::string& target, double at,
            const std::string& language = "en", int viewpoint = -1) {
    scheduler.submit({id, {}, RequestSource::web, "", kind, target, viewpoint, language}, conditions,
                     time_from_seconds(at));
  }
  /// The next visit; a tour that is over says its farewell first.
  std::string next(double at, Point2 robot = {0, 0}) {
    if (scheduler.state().farewell) scheduler.finish_farewell(time_from_seconds(at));
    const auto& visit = scheduler.begin_visit(robot, time_from_seconds(at));
    return visit ? visit->exhibit_id : "";
  }
  void finish(bool is_success, double at) {
    scheduler.finish_visit(is_success, ReasonWord::way_blocked, time_from_seconds(at));
  }
  [[nodiscard]] std::string state_of(const std::string& id) const {
    const BoardEntry* entry = scheduler.state().board.find(id);
    return entry == nullptr ? "" : to_text(entry->status);
  }
  /// Serves everything, each visit a minute; returns the exhibits in order.
  std::vector<std::string> serve_all(double at) {
    std::vector<std::string> order;
    Point2 robot{0, 0};
    for (int i = 0; i < 100; ++i) {
      const std::string exhibit = next(at, robot);
      if (exhibit.empty()) break;
      order.push_back(exhibit);
      robot = scheduler.programme().find_exhibit(exhibit)->pose.position();
      at += 60.0;
      finish(true, at);
    }
    return order;
  }

  std::vector<std::string> serve_all_from_here(double at) {
    std::vector<std::string> order{scheduler.state().visit->exhibit_id};
    finish(true, at);
    for (const std::string& exhibit : serve_all(at)) order.push_back(exhibit);
    return order;
  }

  Conditions conditions;
  SchedulerParams params;
  TourScheduler scheduler{params, programme_on_a_line(), straight_distance(), {}, {}};
};

}  // namespace docent::task_control
