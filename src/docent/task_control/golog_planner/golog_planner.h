#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/task_control/golog/golog_program.h"
#include "docent/task_control/mission/planner.h"
#include "docent/task_control/plan_controller/plan_controller.h"

namespace docent::task_control {

/// How a GOLOG program and the mission work together. Section `mission.golog` of robot.yaml.
struct GologPlannerParams {
  GologParams program;
  double retry_s = 60.0;       ///< [s] > 0 after a fault of the program: meanwhile the plan controller decides
  double contact_s = 30.0;     ///< [s] > 0: so long at its charger without a charge is a failure
  double battery_step = 0.01;  ///< 0..1: the program hears of changes of the charge by so much
  bool has_stand_in = true;    ///< false only in evaluations: nobody decides for a program that has failed
  template <class V>
  void visit(V& v) {
    v("program", program);
    v("retry_s", retry_s);
    v("contact_s", contact_s);
    v("battery_step", battery_step);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A museum's GOLOG program as the planner above the executive ([Rhino1999] 4.3): what happens in the mission becomes
/// events, and the primitive actions that the program begins become tasks. Exhibits are requested as the scheduler lets
/// them be visited: all that are wished for singly, or the next stop of a tour; which of them comes first is the
/// program's choice. A drive to one of them begins a visit on the request board, its explanation fulfills it.
///
/// One task is under way at a time; an action that the executive would have to do beside it fails. A program that is
/// faulty, takes too many inferences, or has ended while somebody waits is reported, and the plan controller serves
/// until it is tried again, anew where its process has ended. One that has ended begins again when the museum opens.
class GologPlanner final : public Planner {
 public:
  /// @param instead_of  why the museum's own program is not carried out; empty: it is
  GologPlanner(const GologPlannerParams& params, GologProgram program, std::string instead_of = {})
      : params_{params}, program_{std::move(program)}, instead_of_{std::move(instead_of)} {}

  void decide(Mission& mission, Time now) override;
  void outcome(Mission& mission, const TaskOrder& order, const ActionOutcome& outcome, Time now) override;
  /// Programs know exhibits alone.
  [[nodiscard]] bool serves_points() const override { return false; }
  [[nodiscard]] std::string memory() const override;
  [[nodiscard]] bool restore(const std::string& memory, TaskOrder& task) override;
  [[nodiscard]] std::string fault() const override { return fault_.empty() ? instead_of_ : fault_; }

 private:
  /// An action that has begun and is not over.
  struct UnderWay {
    GologTerm action;
    Time began;
    std::string task_kind;  ///< of the executive's task; empty: it has none
  };
  [[nodiscard]] std::vector<GologTerm> news(Mission& mission, const Situation& seen, Time now);
  void watch(Mission& mission, const Situation& seen, Time now);
  void run(Mission& mission, Time now);
  void explain_where_asked(Mission& mission, const GologTerm& action, Time now);
  void begin(Mission& mission, const GologTerm& action, Time now);
  void begin_drive(Mission& mission, const std::string& place, const GologTerm& action, Time now);
  void stop(Mission& mission, const GologTerm& action, Time now);
  /// Tells the program how the action went.
  void end(const GologTerm& action, GologOutcome outcome);
  void order(Mission& mission, const GologTerm& action, const std::string& kind, TaskOrder order, Time now);
  /// The plan controller decides from now on.
  void fail(Mission& mission, const Error& error, Time now);
  void remember();

  GologPlannerParams params_;
  GologProgram program_;
  PlanController stand_in_;
  bool has_ended_ = false;  ///< it begins again when the museum opens
  bool stands_in_ = false;  ///< the plan controller decides
  Time retry_at_{};
  std::vector<UnderWay> under_way_;
  struct Told {
    std::string exhibit{};
    std::string language{};
  };
  bool have_left_ = false;  ///< the visitors of the last visit, after a farewell: nobody is asked for more
  Told told_;               ///< the last visit
  /// What the program was told of.
  struct Known {
    std::uint64_t asked_revision = 0;  ///< of the board, when it was asked what may be visited
    Time ask_again{};
    std::set<std::string> requested{};  ///< exhibits for which somebody waits
    std::optional<double> charge{};
    bool is_lost = false;
    bool is_blocked = false;
    bool is_closing = false;
  };
  Known known_;
  struct {
    Time since{};
    int actions = 0;  ///< that have begun or stopped since then
  } hurry_;
  std::string instead_of_;  ///< why the museum's own program is not carried out
  std::string memory_;
  std::string fault_;
};

}  // namespace docent::task_control
