#pragma once

#include <deque>
#include <memory>

#include "docent/base/quantiles.h"
#include "docent/base/time.h"
#include "docent/messages/standard_messages.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// How long what the lasers see takes to reach the wheels: from a sweep's stamp until the base is told what `avoid`
/// chose knowing it. That choice is the first whose stamp is not before the sweep's; the base is told of it by the
/// first cmd_vel that says the same and is not older. Repetitions of former commands do not count.
///
/// By the stamps of sweeps and choices, and by when cmd_vel was received: all by one clock. In virtual time it is 0.
class CommandLatency {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  /// [s], of all sweeps but those of the last two seconds.
  [[nodiscard]] const Quantiles& latencies() const { return latencies_; }
  /// Sweeps upon which nothing was commanded within two seconds.
  [[nodiscard]] std::uint64_t unanswered() const { return unanswered_; }

 private:
  struct Command {
    Time time;
    double linear, angular;  ///< [m/s], [rad/s]
  };
  /// Settles what was seen before `time`.
  void settle(Time time);

  std::deque<Time> sweeps_;
  std::deque<Command> choices_;
  std::deque<Command> told_;
  Quantiles latencies_;
  std::uint64_t unanswered_ = 0;
};

}  // namespace docent::evaluation
