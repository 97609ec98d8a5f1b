#pragma once

#include <utility>

#include "docent/messages/topics.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what people say to the robot goes over the bus.
class BusLink final : public telepresence::RobotLink {
 public:
  explicit BusLink(transport::Bus& bus)
      : requests_{bus.publisher(topics::kRequest)},
        choices_{bus.publisher(topics::kChoice)},
        lamps_{bus.publisher(topics::kButtonLamps)},
        says_{bus.publisher(topics::kSay)},
        votes_{bus.publisher(topics::kVotes)},
        steering_{bus.publisher(topics::kSteering)},
        stops_{bus.publisher(topics::kStop)},
        limits_{bus.publisher(topics::kLimits)} {}

  void tell(docent_msgs::Request request) override { requests_.publish(std::move(request)); }
  void tell(docent_msgs::Choice choice) override { choices_.publish(std::move(choice)); }
  void tell(docent_msgs::Votes votes) override { votes_.publish(std::move(votes)); }
  void tell(docent_msgs::ButtonLamps lamps) override { lamps_.publish(std::move(lamps)); }
  void tell(docent_msgs::Say line) override { says_.publish(std::move(line)); }
  void tell(docent_msgs::Steering steering) override { steering_.publish(std::move(steering)); }
  void tell(docent_msgs::Stop stop) override { stops_.publish(std::move(stop)); }
  void tell(docent_msgs::Limits limits) override { limits_.publish(std::move(limits)); }

 private:
  transport::Publisher<docent_msgs::Request> requests_;
  transport::Publisher<docent_msgs::Choice> choices_;
  transport::Publisher<docent_msgs::ButtonLamps> lamps_;
  transport::Publisher<docent_msgs::Say> says_;
  transport::Publisher<docent_msgs::Votes> votes_;
  transport::Publisher<docent_msgs::Steering> steering_;
  transport::Publisher<docent_msgs::Stop> stops_;
  transport::Publisher<docent_msgs::Limits> limits_;
};

}  // namespace docent::modules
