#pragma once

#include <functional>
#include <string>

#include "docent/telepresence/robot_office/robot_documents.h"

namespace docent::telepresence {

/// Where whoever has an operator's account sends the robot about.
struct RobotOffice {
  /// Any thread: how the robot is.
  std::function<documents::RobotState()> state;
  /// Any thread: it shall go there. Told to the robot once; whoever does not see the goal in `state` says it again.
  std::function<void(const documents::RobotGoal&)> drive;
  /// Any thread: nobody wants that goal any more.
  std::function<void(const std::string& goal)> cancel;
  /// Any thread: a delivery, tidying up, or what becomes of it. Told to the robot once, as above.
  std::function<void(const documents::OfficeWish&)> order;
  /// Any thread: how the last order goes.
  std::function<documents::OfficeReport()> report;
};

/// Why a goal can be none, in English; empty: it can.
[[nodiscard]] std::string fault_of(const documents::RobotGoal& goal);
/// Likewise of an order.
[[nodiscard]] std::string fault_of(const documents::OfficeWish& wish);
/// Another UUID that follows from this one, for its withdrawal. @pre id is a UUID
[[nodiscard]] std::string withdrawal_id(std::string id);

}  // namespace docent::telepresence
