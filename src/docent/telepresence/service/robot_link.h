#pragma once

#include "docent/messages/docent_messages.h"

namespace docent::telepresence {

/// What people on the Web have to say to the robot. Whoever is told what twice takes it as said once.
class RobotLink {
 public:
  RobotLink() = default;
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;
  virtual ~RobotLink() = default;

  virtual void tell(docent_msgs::Request request) = 0;
  virtual void tell(docent_msgs::Choice choice) = 0;
  virtual void tell(docent_msgs::Votes votes) = 0;
  virtual void tell(docent_msgs::ButtonLamps lamps) = 0;
  virtual void tell(docent_msgs::Say line) = 0;
  virtual void tell(docent_msgs::Steering steering) = 0;
  /// What this process's copy of the stop button holds now.
  virtual void tell_stop() = 0;
  virtual void tell(docent_msgs::Limits limits) = 0;
};

}  // namespace docent::telepresence
