#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/telepresence/store/store_queue.h"
#include "docent/vocabulary/reason.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::telepresence {

/// What the robot's own screen may ask for besides wishes, and whether that screen lives.
class ScreenDesk {
 public:
  /// What it needs of others.
  struct Means {
    /// Keeps an answer to the poll; one that came lately is not kept again. Called on the queue's thread.
    std::function<Result<void>(const AnswerMessage& answer, Time now)> keep_answer;
    /// What the robot says of itself to whoever wants help, in that language.
    std::function<std::string(const std::string& language)> help_text;
  };
  using Answer = std::function<void(const std::string& id, const Reason& why_not)>;

  /// Robot and queue outlive it; the means are used until the queue's thread has ended.
  ScreenDesk(RobotLink& robot, StoreQueue& queue, Means means, Time now);

  /// Does what the screen asks for and answers what has an id, once it is done. What anybody could have asked for is no
  /// matter of its own. @param phase  of the mission, as last heard
  void take(const ClientMessage& message, std::optional<MissionPhase> phase, Time now, Answer answer);
  /// Why the last answer could not be written; empty: it was.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// Now and then: a screen that says nothing any more has no lit buttons.
  void look(Time now);

 private:
  [[nodiscard]] Reason help(const HelpMessage& message, std::optional<MissionPhase> phase);
  /// It is told once: a press that is lost can be made again, and one that came late would skip another stop.
  [[nodiscard]] Reason skip(const SkipMessage& message, std::optional<MissionPhase> phase, Time now);
  void light(const std::vector<int>& lit, Time now);

  RobotLink& robot_;
  StoreQueue& queue_;
  Means means_;
  std::vector<int> lit_;
  Time heard_;
  std::string fault_;
};

}  // namespace docent::telepresence
