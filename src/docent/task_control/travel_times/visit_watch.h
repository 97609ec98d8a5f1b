#pragma once

#include <optional>
#include <string>

#include "docent/base/time.h"
#include "docent/task_control/travel_times/travel_times.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// A way that was driven.
struct DrivenWay {
  std::string from;  ///< place; empty: anywhere
  std::string to;
  double way_m = 0.0;    ///< [m]
  double seconds = 0.0;  ///< [s] from the order to set out to the first word
};
/// A visit that was made to its end.
struct MadeVisit {
  VisitCourse course{};
  double seconds = 0.0;  ///< [s] from the first word to the report that it is done
};

/// Times a task by the reports of how it goes. What was broken off, failed, or was under way at a restart teaches
/// nothing.
class VisitWatch {
 public:
  void set_out(std::string from, std::string to, double way_m, Time now);
  void forget() { step_ = Step::none; }
  struct Seen {
    std::optional<DrivenWay> way;
    std::optional<MadeVisit> visit;
  };
  /// The next report; what it completes.
  [[nodiscard]] Seen report(TaskStatus status, Time now);

 private:
  enum class Step { none, driving, explaining, asking, explaining_more };
  Step step_ = Step::none;
  bool was_asked_ = false;
  DrivenWay way_;
  Time set_out_{};
  Time arrived_{};
};

}  // namespace docent::task_control
