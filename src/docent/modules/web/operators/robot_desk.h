#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "docent/geometry/pose2.h"
#include "docent/messages/mission_messages.h"
#include "docent/messages/office_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/robot_office/robot_office.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: how the robot is, for a fleet manager, and where it sends the robot: the desk of /api/v1 asks
/// on a thread of its own. A place is a request of the staff, like any other.
class RobotDesk {
 public:
  /// The bus outlives it. What has become of its office is used no longer than it.
  explicit RobotDesk(transport::Bus& bus);

  [[nodiscard]] std::shared_ptr<const telepresence::RobotOffice> office() const { return office_; }
  /// Where the robot is now; nullopt: it does not know.
  void see(const std::optional<Pose2>& map_from_base);
  void see(const telepresence::documents::OperationMessage& operation);

 private:
  void subscribe();
  void take(const docent_msgs::RequestBoard& board);
  void tell(docent_msgs::Request request);

  transport::Bus& bus_;
  transport::Publisher<docent_msgs::Request> requests_;
  transport::Publisher<docent_msgs::OfficeOrder> orders_;
  std::mutex mutex_;
  telepresence::documents::RobotState state_;     ///< guarded by mutex_
  telepresence::documents::OfficeReport report_;  ///< likewise
  std::shared_ptr<const telepresence::RobotOffice> office_;
};

}  // namespace docent::modules
