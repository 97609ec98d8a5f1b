#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "docent/messages/operation_messages.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/transport/bus.h"
#include "docent/vocabulary/reason.h"

namespace docent::modules {

/// For the `web` module: what operators order. One at a time holds the lease to steer, as long as they send; the robot
/// moves only while they hold the dead man's switch down. The stop button needs no lease, and it outlives a restart.
class OperatorDesk {
 public:
  /// Told what an operator did, for the audit log.
  using Note = std::function<void(std::string who, std::string what, std::string about)>;

  /// The bus outlives it. @param stop_file  is there while the robot is stopped
  OperatorDesk(transport::Bus& bus, std::filesystem::path stop_file, Note note);

  /// None: it is done. nullopt: no operator's message.
  [[nodiscard]] std::optional<Reason> take(const telepresence::Caller& caller,
                                           const telepresence::ClientMessage& message);
  void left(const telepresence::Caller& caller);
  [[nodiscard]] telepresence::documents::OperationMessage document() const;
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  struct Lease {
    telepresence::Caller holder;
    telepresence::SteerMessage wish;
    Time heard;
  };
  [[nodiscard]] Reason take_lease(const telepresence::Caller& caller, bool wants);
  [[nodiscard]] Reason steer(const telepresence::Caller& caller, const telepresence::SteerMessage& wish);
  [[nodiscard]] Reason stop(const telepresence::Caller& caller, bool is_stopped);
  [[nodiscard]] Reason set_hours(const telepresence::Caller& caller, OperatingMode mode);
  void publish_steering();
  void release();

  transport::Bus& bus_;
  const std::filesystem::path stop_file_;
  const Note note_;
  transport::Publisher<docent_msgs::Steering> steering_;
  transport::Publisher<docent_msgs::Stop> stops_;
  transport::Publisher<docent_msgs::Limits> limits_publisher_;
  std::optional<Lease> lease_;
  docent_msgs::Stop stop_;
  std::optional<docent_msgs::Limits> limits_;  ///< as somebody said them last
  std::string fault_;
};

}  // namespace docent::modules
