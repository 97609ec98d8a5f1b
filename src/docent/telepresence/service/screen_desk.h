#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {

/// What the robot's own screen may ask for besides wishes, and whether that screen lives.
class ScreenDesk {
 public:
  /// What it needs of others.
  struct Means {
    /// Keeps an answer to the poll; one that came lately is not kept again.
    std::function<Result<void>(const AnswerMessage& answer, Time now)> keep_answer;
    /// What the robot says of itself to whoever wants help, in that language.
    std::function<std::string(const std::string& language)> help_text;
  };
  /// The robot outlives it.
  ScreenDesk(RobotLink& robot, Means means, Time now);

  /// Does what the screen asks for. nullopt: that is no matter of its own, anybody could have asked. A reason: why
  /// not; none: done. `phase`: of the mission, as last heard.
  [[nodiscard]] std::optional<Reason> take(const ClientMessage& message, std::optional<MissionPhase> phase, Time now);
  /// Why the last answer could not be written; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// Now and then: a screen that says nothing any more has no lit buttons.
  void look(Time now);

 private:
  [[nodiscard]] Reason help(const HelpMessage& message, std::optional<MissionPhase> phase);
  void light(const std::vector<int>& lit, Time now);

  RobotLink& robot_;
  Means means_;
  std::vector<int> lit_;
  Time heard_;
  std::string fault_;
};

}  // namespace docent::telepresence
