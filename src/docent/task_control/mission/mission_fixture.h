#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/task_control/mission/mission.h"
#include "docent/task_control/plan_controller/plan_controller.h"

// For tests of the mission and its planners.

namespace docent::task_control {

inline Programme small_programme() {
  Programme programme;
  programme.languages = {"en"};
  programme.exhibits = {{"a", {5, 0, {}}, {}, 20.0, false}, {"b", {10, 0, {}}, {}, 20.0, false}};
  programme.tours = {{"both", {"a", "b"}, 0.0}};
  programme.home = {0, 0, {}};
  programme.charger = Pose2{0, 3, {}};
  return programme;
}

class MissionTest : public testing::Test {
 protected:
  MissionTest() { make({}); }
  void make(MissionMemory memory) {
    memory.deployment = "dep";
    mission = std::make_unique<Mission>(params, programme, straight_distance(), std::move(memory),
                                        std::make_unique<PlanController>(), time());
  }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }
  /// Passes time with ticks; the robot stays where it is.
  void pass(double duration_s, bool is_localized = true) {
    for (const double end = now_s + duration_s; now_s < end; now_s += 0.5) {
      mission->localization(is_localized, robot, time());
      mission->tick(time());
    }
  }
  void wish(const std::string& id, RequestKind kind, const std::string& target) {
    mission->submit({id, {}, RequestSource::web, "", kind, target, -1, "en"}, time());
  }
  void battery(double charge, std::optional<bool> is_charging = false) {
    mission->battery(charge, is_charging, time());
  }
  [[nodiscard]] RequestStatus status_of(const std::string& id) const {
    return mission->memory().schedule.board.find(id)->status;
  }
  void report(TaskStatus state) { mission->report(mission->task().id, state, {}, time()); }
  [[nodiscard]] MissionPhase phase() const { return mission->summary(time()).phase; }
  bool happened(EventKind kind) {
    for (auto& happening : mission->take_happenings()) seen.push_back(happening.kind);
    return std::find(seen.begin(), seen.end(), kind) != seen.end();
  }

  MissionParams params;
  Programme programme = small_programme();
  double now_s = 0.0;
  Point2 robot{0, 0};
  std::unique_ptr<Mission> mission;
  std::vector<EventKind> seen;
};

}  // namespace docent::task_control
