#pragma once

#include "docent/task_control/mission/planner.h"

namespace docent::task_control {

/// Minerva's structured reactive controller ([Minerva2000] 5.3): routines that watch the situation, in the order of
/// their priority. The first one that applies acts and ends the round, so that the plan under way goes on unless
/// something more urgent revises it:
///
///   lost                suspends what is under way and looks for the robot's place
///   found               resumes it
///   farewell under way  lets it be said
///   battery low         breaks off what would take more charge than there is, between two explanations
///   visit under way     lets it go on
///   battery low soon    charges between two tours, before it must ([Minerva2000] 5.3: periodically)
///   next visit          the scheduler's choice, made anew after each explanation and each new request
///   farewell            the last word of a tour that has ended
///   charge first        what comes next would take too much
///   mingle              attracts people between two tours ([Minerva2000] 6.3)
///   rest                charges when that is worth while, else goes home
class PlanController final : public Planner {
 public:
  void decide(Mission& mission, Time now) override;
};

}  // namespace docent::task_control
