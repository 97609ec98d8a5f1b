#include "docent/task_control/golex/docking.h"

#include <array>

namespace docent::task_control {
namespace {

/// A wait for the contact, or a drive to a place on the charger's axis.
struct Step {
  const char* move;  ///< nullptr: it waits
  double side;       ///< of the stand-off: 1 before the charger, -1 behind it, 0 at it
};
constexpr std::array kSteps{
    Step{nullptr, 0.0}, Step{"closer", 0.0},  Step{nullptr, 0.0},       Step{"before", 1.0}, Step{"from-before", 0.0},
    Step{nullptr, 0.0}, Step{"behind", -1.0}, Step{"from-behind", 0.0}, Step{nullptr, 0.0},
};

}  // namespace

std::optional<Docking::Move> Docking::move() const {
  if (step_ >= kSteps.size() || kSteps.at(step_).move == nullptr) return std::nullopt;
  const Step& step = kSteps.at(step_);
  const Pose2 charger_from_base{step.side * params_.stand_off_m, 0.0, {}};
  return Move{step.move, map_from_charger_ * charger_from_base, params_.closer_tolerance};
}

Docking::State Docking::step(Contact contact, std::optional<GoalStatus> moved, Time now) {
  if (step_ >= kSteps.size()) return State::failed;
  const bool is_waiting = kSteps.at(step_).move == nullptr;
  if (is_waiting && (contact == Contact::made || contact == Contact::unknown)) return State::docked;
  const double limit_s = is_waiting ? params_.contact_s : params_.move_s;
  if (moved != GoalStatus::arrived && now - since_ < seconds(limit_s)) return State::under_way;
  if (is_waiting && contact == Contact::unheard) return State::docked;  // a robot without a gauge
  ++step_;
  since_ = now;
  return step_ >= kSteps.size() ? State::failed : move() ? State::sets_out : State::under_way;
}

}  // namespace docent::task_control
