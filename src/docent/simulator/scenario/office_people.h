#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/interaction_messages.h"
#include "docent/messages/office_messages.h"
#include "docent/simulator/scenario/office_event.h"

namespace docent::simulator {

/// People in an office: who orders something of the robot, and a helper who does what it asks for. The helper takes the
/// thing at which the robot points, wherever that is, and presses the green button.
class OfficePeople {
 public:
  struct Output {
    std::vector<docent_msgs::OfficeOrder> orders;
    std::vector<docent_msgs::Button> presses;
    std::optional<Point2> takes{};  ///< [m], world: the litter that lies there
  };
  void play(const OfficeEvent& event);
  void see(const docent_msgs::OfficeState& state, Time now);
  /// Ten times a second or so.
  [[nodiscard]] Output step(Time now);

 private:
  std::vector<docent_msgs::OfficeOrder> orders_;
  std::size_t ordered_ = 0;
  std::optional<double> helps_after_;  ///< [s]
  docent_msgs::OfficeState state_;
  std::optional<Time> asked_;  ///< since when the robot waits for somebody
};

}  // namespace docent::simulator
