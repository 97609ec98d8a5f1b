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

/// The tour whose visitors the robot leads with this order, when it led those of `last_tour` before; empty: none. They
/// are greeted once: who waits while the battery is charged, or comes along to a place for which somebody else wished
/// in between, is no stranger.
[[nodiscard]] inline std::string tour_after(const TaskOrder& order, bool has_drive, const std::string& last_tour) {
  if (order.kind == TaskKind::farewell || order.kind == TaskKind::home || order.kind == TaskKind::mingle) return "";
  if (order.kind == TaskKind::charge) return order.tour_id == last_tour ? last_tour : "";
  return has_drive && !order.tour_id.empty() ? order.tour_id : last_tour;
}

}  // namespace docent::task_control
