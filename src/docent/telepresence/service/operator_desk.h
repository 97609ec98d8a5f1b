#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/messages/operation_messages.h"
#include "docent/messages/stop_button/stop_register.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/server/web_server.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// What operators order. One at a time holds the lease to steer, as long as they send; the robot
/// moves only while they hold the dead man's switch down. The stop button needs no lease; it is answered when enough
/// processes of the robot hold the order. Nothing here waits for a disk.
class OperatorDesk {
 public:
  /// Told what an operator did, for the audit log. @pre returns at once
  using Note = std::function<void(std::string who, std::string what, std::string about)>;

  /// The robot and the button outlive it. @param button  this process's copy of it
  /// @param mode_speeds  [m/s] that the museum allows, by the name of the mode
  OperatorDesk(RobotLink& robot, StopRegister& button, Note note, std::map<std::string, double> mode_speeds);

  /// @returns whether it was an operator's message; its answer is among the next `answers`
  [[nodiscard]] bool take(const Caller& caller, const ClientMessage& message, Time now);
  void left(const Caller& caller, Time now);
  /// As somebody said them.
  void see(const docent_msgs::Limits& limits);
  /// Ten times a second: steers as whoever holds the lease wishes, and ends it when they are silent.
  void steer_on(Time now);
  [[nodiscard]] documents::OperationMessage document() const;

  /// What became of a message.
  struct Answer {
    ViewerId viewer{};
    std::string id;  ///< empty: of steering, which has none and is answered only where it was refused
    Reason why_not;  ///< none: it is done
  };
  /// All that are due; each is returned once.
  [[nodiscard]] std::vector<Answer> answers(Time now);

 private:
  struct Lease {
    Caller holder;
    SteerMessage wish;
    Time heard;
  };
  /// An order of the stop button that the robot has not confirmed yet.
  struct Unconfirmed {
    ViewerId viewer{};
    std::string id;
    std::uint64_t number = 0;
    Time given_up;
  };
  [[nodiscard]] Reason take_lease(const Caller& caller, bool wants, Time now);
  [[nodiscard]] Reason steer(const Caller& caller, const SteerMessage& wish, Time now);
  void stop(const Caller& caller, const StopMessage& wish, Time now);
  [[nodiscard]] Reason set_hours(const Caller& caller, OperatingMode mode);
  /// [m/s] what the museum allows in the mode; where its hours decide, in the fastest of them, for then each is held to
  /// its own. nullopt: the museum says nothing.
  [[nodiscard]] std::optional<double> speed_in(const std::string& mode) const;
  void release(Time now);

  RobotLink& robot_;
  StopRegister& button_;
  const Note note_;
  const std::map<std::string, double> mode_speeds_;  ///< [m/s]
  std::optional<Lease> lease_;
  std::optional<docent_msgs::Limits> limits_;  ///< as somebody said them last
  std::optional<double> slower_;               ///< [m/s] that somebody set below what their mode allows
  std::vector<Unconfirmed> unconfirmed_;
  std::vector<Answer> answers_;
};

}  // namespace docent::telepresence
