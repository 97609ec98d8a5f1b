#pragma once

#include <string>

#include "docent/geometry/pose2.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// One primitive action of the plan, for the executive.
struct TaskOrder {
  std::string id;  ///< empty: nothing to do
  Word<TaskKind> kind;
  std::string exhibit_id;  ///< what it is about; for charge: of the visit that is broken off for it
  Pose2 map_from_base;     ///< where to stand
  std::string language;
  bool offer_more = true;
  std::string tour_id;  ///< for charge: the tour that is broken off for it
};

}  // namespace docent::task_control
