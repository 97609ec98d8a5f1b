#pragma once

#include <optional>
#include <string>

#include "docent/messages/mission_messages.h"
#include "docent/messages/request_messages.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

/// Answers to the robot's question. The first one counts, and the robot is told it again until the question is closed.
class AnswerDesk {
 public:
  /// The robot outlives it.
  explicit AnswerDesk(RobotLink& robot) : robot_{robot} {}

  /// What the robot asks now.
  void see(const docent_msgs::Prompt& prompt) { prompt_ = prompt; }
  /// None: it is taken, or another one was before it.
  [[nodiscard]] Reason take(const ChoiceMessage& message, RequestSource source);
  void resend();

 private:
  RobotLink& robot_;
  std::optional<docent_msgs::Prompt> prompt_;
  std::optional<docent_msgs::Choice> choice_;
};

}  // namespace docent::telepresence
