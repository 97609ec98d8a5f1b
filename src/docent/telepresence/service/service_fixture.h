#pragma once

#include <utility>
#include <vector>

#include "docent/telepresence/service/robot_link.h"
#include "docent/telepresence/service/viewers.h"

// For tests of the service.

namespace docent::telepresence {

/// Writes down what the robot is told.
class RobotEar final : public RobotLink {
 public:
  void tell(docent_msgs::Request request) override { requests.push_back(std::move(request)); }
  void tell(docent_msgs::Choice choice) override { choices.push_back(std::move(choice)); }
  void tell(docent_msgs::Votes counts) override { votes.push_back(std::move(counts)); }
  void tell(docent_msgs::ButtonLamps message) override { lamps.push_back(std::move(message.lit)); }
  void tell(docent_msgs::Say line) override { says.push_back(std::move(line)); }
  void tell(docent_msgs::Steering message) override { steered.push_back(std::move(message)); }
  void tell_stop() override { ++stops; }
  void tell(docent_msgs::Limits message) override { limits.push_back(std::move(message)); }

  std::vector<docent_msgs::Request> requests;
  std::vector<docent_msgs::Choice> choices;
  std::vector<docent_msgs::Votes> votes;
  std::vector<std::vector<std::int32_t>> lamps;
  std::vector<docent_msgs::Say> says;
  std::vector<docent_msgs::Steering> steered;
  int stops = 0;  ///< times that it was told of the stop button
  std::vector<docent_msgs::Limits> limits;
};

/// Writes down what viewers see and hear.
class ViewerEyes final : public Viewers {
 public:
  void show(slots::Slot slot, std::string text) override { shown.emplace_back(slot, std::move(text)); }
  void answer(ViewerId viewer, std::string text) override { answers.emplace_back(viewer, std::move(text)); }
  [[nodiscard]] std::vector<std::string> of(slots::Slot slot) const {
    std::vector<std::string> texts;
    for (const auto& [place, text] : shown)
      if (place == slot) texts.push_back(text);
    return texts;
  }

  std::vector<std::pair<slots::Slot, std::string>> shown;
  std::vector<std::pair<ViewerId, std::string>> answers;
};

}  // namespace docent::telepresence
