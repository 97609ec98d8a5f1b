#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "docent/messages/operation_messages.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// What operators order. One at a time holds the lease to steer, as long as they send; the robot
/// moves only while they hold the dead man's switch down. The stop button needs no lease, and it outlives a restart.
class OperatorDesk {
 public:
  /// Told what an operator did, for the audit log.
  using Note = std::function<void(std::string who, std::string what, std::string about)>;

  /// The robot outlives it. @param stop_file  is there while the robot is stopped
  OperatorDesk(RobotLink& robot, std::filesystem::path stop_file, Note note, Time now);

  /// None: it is done. nullopt: no operator's message.
  [[nodiscard]] std::optional<Reason> take(const Caller& caller, const ClientMessage& message, Time now);
  void left(const Caller& caller, Time now);
  /// As somebody said them.
  void see(const docent_msgs::Limits& limits) { limits_ = limits; }
  /// Another gateway has a stop button too.
  void see(const docent_msgs::Stop& stop);
  /// Ten times a second: steers as whoever holds the lease wishes, and ends it when they are silent.
  void steer_on(Time now);
  [[nodiscard]] documents::OperationMessage document() const;
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  struct Lease {
    Caller holder;
    SteerMessage wish;
    Time heard;
  };
  [[nodiscard]] Reason take_lease(const Caller& caller, bool wants, Time now);
  [[nodiscard]] Reason steer(const Caller& caller, const SteerMessage& wish, Time now);
  [[nodiscard]] Reason stop(const Caller& caller, bool is_stopped, Time now);
  [[nodiscard]] Reason set_hours(const Caller& caller, OperatingMode mode);
  void release(Time now);

  RobotLink& robot_;
  const std::filesystem::path stop_file_;
  const Note note_;
  std::optional<Lease> lease_;
  docent_msgs::Stop stop_;
  std::optional<docent_msgs::Limits> limits_;  ///< as somebody said them last
  std::string fault_;
};

}  // namespace docent::telepresence
