#pragma once

#include <string>
#include <utility>

#include "docent/messages/topics.h"
#include "docent/modules/shared/stop_keeper.h"
#include "docent/telepresence/service/robot_link.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// For the `web` module: what people say to the robot goes over the bus. It keeps this process's copy of the stop
/// button.
class BusLink final : public telepresence::RobotLink {
 public:
  /// @param name  of this gateway, no other's
  BusLink(const ModuleContext& context, std::string name) : BusLink{context.bus, context, std::move(name)} {}

  [[nodiscard]] const StopKeeper& stop() const { return stop_; }
  [[nodiscard]] StopKeeper& stop() { return stop_; }
  [[nodiscard]] const std::string& name() const { return stop_.button().name(); }

  void tell(docent_msgs::Request request) override { requests_.publish(std::move(request)); }
  void tell(docent_msgs::Choice choice) override { choices_.publish(std::move(choice)); }
  void tell(docent_msgs::Votes votes) override { votes_.publish(std::move(votes)); }
  void tell(docent_msgs::ButtonLamps lamps) override { lamps_.publish(std::move(lamps)); }
  void tell(docent_msgs::Say line) override { says_.publish(std::move(line)); }
  void tell(docent_msgs::Steering steering) override { steering_.publish(std::move(steering)); }
  void tell_stop() override { stop_.tell(); }
  void tell(docent_msgs::Limits limits) override { limits_.publish(std::move(limits)); }

 private:
  BusLink(transport::Bus& bus, const ModuleContext& context, std::string name)
      : stop_{context, std::move(name), {}},
        requests_{bus.publisher(topics::kRequest)},
        choices_{bus.publisher(topics::kChoice)},
        lamps_{bus.publisher(topics::kButtonLamps)},
        says_{bus.publisher(topics::kSay)},
        votes_{bus.publisher(topics::kVotes)},
        steering_{bus.publisher(topics::kSteering)},
        limits_{bus.publisher(topics::kLimits)} {}

  StopKeeper stop_;
  transport::Publisher<docent_msgs::Request> requests_;
  transport::Publisher<docent_msgs::Choice> choices_;
  transport::Publisher<docent_msgs::ButtonLamps> lamps_;
  transport::Publisher<docent_msgs::Say> says_;
  transport::Publisher<docent_msgs::Votes> votes_;
  transport::Publisher<docent_msgs::Steering> steering_;
  transport::Publisher<docent_msgs::Limits> limits_;
};

}  // namespace docent::modules
