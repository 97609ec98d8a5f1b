#pragma once

#include <cstddef>
#include <memory>

#include "docent/collision_avoidance/local_planner/local_planner.h"

namespace docent::collision_avoidance::testing {

/// What a planner has been told.
struct HeadlongLog {
  int asked = 0;
  int forgot = 0;
  Point2 carrot{};
  std::size_t path = 0;  ///< via-points
};

/// A planner of somebody else's: wants the same velocity whatever stands there.
class Headlong final : public LocalPlanner {
 public:
  Headlong(const Velocity& wish, HeadlongLog* log) : wish_{wish}, log_{log} {}
  [[nodiscard]] LocalPlan plan(const LocalTask& task) override {
    if (log_ != nullptr) *log_ = {log_->asked + 1, log_->forgot, task.carrot, task.path.size()};
    LocalPlan plan{task};
    plan.command = wish_;
    return plan;
  }
  void forget() override {
    if (log_ != nullptr) ++log_->forgot;
  }

 private:
  Velocity wish_;
  HeadlongLog* log_;
};

[[nodiscard]] inline std::unique_ptr<LocalPlanner> headlong(const Velocity& wish, HeadlongLog* log = nullptr) {
  return std::make_unique<Headlong>(wish, log);
}

}  // namespace docent::collision_avoidance::testing
