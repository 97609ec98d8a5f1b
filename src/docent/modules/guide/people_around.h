#pragma once

#include <optional>
#include <vector>

#include "docent/interaction/head/gaze_choice.h"
#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// Where people are now, seen from the robot: tracked people carried on by odometry.
class PeopleAround {
 public:
  explicit PeopleAround(transport::Bus& bus) : bus_{bus} {
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry, [this](const auto& odometry) {
      odom_from_base_ = from_message(odometry.pose.pose);
      odometry_received_ = bus_.now();
    });
    bus_.subscribe<docent_msgs::People>(topics::kPeopleInOdom, [this](const auto& people) {
      people_ = people;
      people_received_ = bus_.now();
    });
  }
  PeopleAround(const PeopleAround&) = delete;
  PeopleAround& operator=(const PeopleAround&) = delete;
  ~PeopleAround() = default;

  /// Where the robot is in odometry's frame; nullopt: odometry was silent for a second, so it may be dead.
  [[nodiscard]] std::optional<Pose2> odom_from_base() const {
    return bus_.now() - odometry_received_ <= kStaleAfter ? odom_from_base_ : std::nullopt;
  }
  /// nullopt: nobody has looked for people within the last second. Robot frame.
  [[nodiscard]] std::optional<std::vector<interaction::SeenPerson>> people() const {
    const auto pose = odom_from_base();
    if (!pose || bus_.now() - people_received_ > kStaleAfter) return std::nullopt;
    const Pose2 base_from_odom = inverse(*pose);
    std::vector<interaction::SeenPerson> seen;
    for (const docent_msgs::Person& person : people_.people) {
      const Point2 in_odom{static_cast<double>(person.x), static_cast<double>(person.y)};
      const Point2 velocity{static_cast<double>(person.vx), static_cast<double>(person.vy)};
      seen.push_back({person.id, base_from_odom * in_odom, base_from_odom * velocity - base_from_odom.position()});
    }
    return seen;
  }

 private:
  static constexpr Duration kStaleAfter = std::chrono::seconds{1};

  transport::Bus& bus_;
  std::optional<Pose2> odom_from_base_;
  Time odometry_received_{};
  docent_msgs::People people_;
  Time people_received_{};
};

}  // namespace docent::modules
