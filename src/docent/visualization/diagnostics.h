#pragma once

#include <map>
#include <string>

#include "docent/base/time.h"
#include "docent/messages/docent_messages.h"

namespace docent::visualization {

/// What the modules say of their health, as ROS 2's tools of diagnostics read it: one status for each module that was
/// heard. A module that is starting or degraded is a warning, one that is faulted an error; one that has been silent
/// for more than two seconds is stale.
class Diagnostics {
 public:
  void hear(const docent_msgs::Health& health, Time now);
  [[nodiscard]] diagnostic_msgs::DiagnosticArray message(Time now) const;

 private:
  struct Heard {
    docent_msgs::Health health;
    Time at;
  };
  std::map<std::string, Heard> modules_;
};

}  // namespace docent::visualization
