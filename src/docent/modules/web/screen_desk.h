#pragma once

#include <optional>
#include <string>

#include "docent/interaction/kiosk/poll.h"
#include "docent/messages/topics.h"
#include "docent/telepresence/client_message.h"
#include "docent/transport/bus.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {

/// For the `web` module: what the robot's own screen may ask for besides wishes, and whether that screen lives.
class ScreenDesk {
 public:
  /// @param poll  the file of the visitors' answers
  ScreenDesk(transport::Bus& bus, const std::filesystem::path& poll);

  /// Does what the screen asks for. nullopt: that is no matter of its own, anybody could have asked. A reason: why
  /// not; none: done. `phase`: of the mission, as last heard.
  [[nodiscard]] std::optional<Reason> take(const telepresence::ClientMessage& message,
                                           std::optional<MissionPhase> phase);
  /// Why the last answer could not be written; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// Now and then: a screen that says nothing any more has no lit buttons.
  void look();

 private:
  [[nodiscard]] Reason help(const telepresence::HelpMessage& message, std::optional<MissionPhase> phase);
  void light(const std::vector<int>& lit);

  transport::Bus& bus_;
  interaction::Poll poll_;
  transport::Publisher<docent_msgs::ButtonLamps> lamps_;
  transport::Publisher<docent_msgs::Say> says_;
  std::vector<int> lit_;
  Time heard_;
  std::string fault_;
};

}  // namespace docent::modules
