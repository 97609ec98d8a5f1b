#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "docent/base/files.h"
#include "docent/base/shipped_files.h"
#include "docent/task_control/golog_planner/golog_planner.h"
#include "docent/task_control/mission/mission_fixture.h"

// For tests of missions with a GOLOG program.

namespace docent::task_control {

/// Three exhibits on a line, as in [Rhino1999] Figs. 21 and 22: e5 lies between e1 and e12.
inline Programme line_museum() {
  Programme programme;
  programme.languages = {"en", "de"};
  for (const auto& [id, x] : {std::pair{"e1", 4.0}, std::pair{"e5", 9.0}, std::pair{"e12", 20.0}}) {
    ProgrammeExhibit& exhibit = programme.exhibits.emplace_back();
    exhibit.id = id;
    exhibit.pose = {x, 0, {}};
  }
  programme.tours = {{"back", {"e12", "e1"}, 0.0}, {"forth", {"e1", "e12"}, 0.0}};
  programme.home = {0, 0, {}};
  programme.charger = Pose2{0, 3, {}};
  return programme;
}

/// The mission with a program; the test is the executive.
class GologPlannerTest : public MissionTest {
 protected:
  void start(const std::filesystem::path& file, MissionMemory memory = {}) {
    auto program = GologProgram::load(golog.program, file, line_museum(), straight_distance());
    ASSERT_TRUE(program) << program.error().message;
    memory.deployment = "dep";
    mission = std::make_unique<Mission>(MissionParams{}, line_museum(), straight_distance(), std::move(memory),
                                        std::make_unique<GologPlanner>(golog, std::move(*program)), time());
    pass(5.0);
  }
  void start_shipped(MissionMemory memory = {}) { start(shipped_path("prolog/tour_guide.pl"), std::move(memory)); }
  /// A program of these lines.
  void start_text(const std::string& text, MissionMemory memory = {}) {
    const auto file = std::filesystem::temp_directory_path() / ("docent_golog_" + std::to_string(getpid()) + ".pl");
    ASSERT_TRUE(write_file_atomically(file, text));
    start(file, std::move(memory));
    std::filesystem::remove(file);
  }
  void wish(const std::string& id, RequestKind kind, const std::string& target) {
    MissionTest::wish(id, kind, target);
    pass(0.5);
  }
  /// "drive e1": what the robot does now.
  [[nodiscard]] std::string task() const {
    const TaskOrder& order = mission->task();
    return order.id.empty() ? "" : order.kind.text() + (order.exhibit_id.empty() ? "" : " " + order.exhibit_id);
  }
  void report(TaskStatus status, bool took_long = false) {
    const TaskOrder order = mission->task();
    if (status == TaskStatus::done &&
        (order.kind == TaskKind::home || order.kind == TaskKind::charge || order.kind.text() == "drive"))
      robot = order.map_from_base.position();
    mission->report(order.id, status, ReasonWord::way_blocked, time(), took_long);
    pass(0.5);
  }
  /// Every action succeeds, until there is nothing to do; what the robot did.
  std::vector<std::string> run(int most = 30) {
    std::vector<std::string> tasks;
    while (!task().empty() && most-- > 0) {
      tasks.push_back(task());
      report(TaskStatus::done);
    }
    return tasks;
  }

  GologPlannerParams golog;
};

using Tasks = std::vector<std::string>;

}  // namespace docent::task_control
