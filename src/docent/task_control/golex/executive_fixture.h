#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "docent/task_control/golex/executive.h"

// For tests of the executive.

namespace docent::task_control {

inline ExecutiveTask visit(const std::string& id, bool has_more = true) {
  return {{id, TaskKind::visit, "sputnik", {3, 4, Angle::degrees(90)}, "en", true, ""},
          "Sputnik",
          "It was the first satellite.",
          has_more ? "It weighed 83 kilograms." : ""};
}

class ExecutiveTest : public testing::Test {
 protected:
  ExecutiveTest() { collect(); }
  void collect() {
    auto actions = executive.take_actions();
    if (actions.drive) drive = actions.drive;
    if (actions.report) state = *actions.report;
    said.insert(said.end(), actions.utterances.begin(), actions.utterances.end());
    for (const LadderStep& step : actions.reactions) rungs.push_back(step.rung);
    happenings.insert(happenings.end(), actions.happenings.begin(), actions.happenings.end());
    if (actions.must_save) saved = executive.memory();
  }
  void start(const ExecutiveTask& task) {
    executive.set_task(task, time());
    collect();
  }
  /// What the planner says; a drive that goes on makes progress.
  void goal(GoalStatus what) {
    if (what != GoalStatus::blocked) progress_s = now_s;
    executive.goal_report({drive->id, what, 1.0, 1.0, now_s - progress_s, "", "none"}, time());
    collect();
  }
  void speech(const std::string& id, SpeechStatus what, double duration_s = 3.0) {
    executive.speech_report({id, what, time(), duration_s}, time());
    collect();
  }
  void pass(double duration_s) {
    for (const double end = now_s + duration_s; now_s < end;) {
      now_s += 0.25;
      executive.tick(time());
      collect();
    }
  }
  void restart() {
    executive = Executive{{}, default_decomposition(), saved, time()};
    said.clear();
    drive.reset();
    state = {};
    collect();
  }
  [[nodiscard]] Time time() const { return time_from_seconds(now_s); }
  [[nodiscard]] long count(const std::string& id) const {
    return std::count_if(said.begin(), said.end(), [&](const Utterance& line) { return line.id == id; });
  }

  double now_s = 100.0;
  double progress_s = 100.0;
  Executive executive{{}, default_decomposition(), {}, time_from_seconds(100.0)};
  std::optional<DriveOrder> drive;
  TaskReport state;
  ExecutiveMemory saved;
  std::vector<Utterance> said;
  std::vector<Happening> happenings;
  std::vector<Rung> rungs;
};

}  // namespace docent::task_control
