#pragma once

#include <memory>

#include "docent/base/quantiles.h"
#include "docent/base/time.h"
#include "docent/messages/standard_messages.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// How old what the robot knows of itself is when it is told: from the stamp of a belief, or of the virtual
/// measurements of hazards and border, to when it was received; from the first belief on that knows the place, for a
/// process that starts hears what was latched long ago. By one clock; in virtual time only waiting counts.
class MessageAges {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const Quantiles& beliefs() const { return beliefs_; }  ///< [s]
  [[nodiscard]] const Quantiles& hazards() const { return hazards_; }  ///< [s]

 private:
  bool was_localized_ = false;
  Quantiles beliefs_;
  Quantiles hazards_;
};

}  // namespace docent::evaluation
