#pragma once

#include <optional>
#include <string>

#include "docent/interaction/attract/style.h"
#include "docent/task_control/tour_scheduler/task_order.h"

namespace docent::task_control {

/// A task with all that is needed to do it.
struct ExecutiveTask {
  TaskOrder order;
  std::string title;
  std::string short_text;                                ///< as it is spoken
  std::string long_text;                                 ///< empty: there is no more to tell
  double wait_s = 0.0;                                   ///< [s] it stays at the exhibit after its last word
  std::optional<interaction::AttractionAction> style{};  ///< in which it attracts people
};

}  // namespace docent::task_control
