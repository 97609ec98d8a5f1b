#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/messages/truth_messages.h"
#include "docent/simulator/body/body.h"

namespace docent::simulator {

/// Turns touches into contacts, each reported once (architecture 9), with the finding whether the robot had braked in
/// time before a person: full braking of the wheels had begun within 0.3 s of the person first being in sight inside
/// the stopping distance (the 0.3 s included), and it was still braking or standing at the touch.
///
/// A report waits until those 0.3 s are over: what they say is not known before.
class ContactLog {
 public:
  struct PersonSample {
    std::uint32_t id = 0;
    Point2 offset{};  ///< [m] from the robot's centre
    double radius = 0.25;
    /// A ray of a scanner, within its field and range, reaches them; asked for inside the stopping distance only.
    bool in_sight = false;
  };
  /// Those near the robot, once every step, before the touches.
  void watch(Time now, const Body& body, const std::vector<PersonSample>& people);
  /// @param other_speed  [m/s] of the person towards the robot; 0 for things
  struct Touching {
    std::string kind;
    std::string what;
    Point2 point{};
    Point2 towards{};  ///< unit vector from the robot's centre
    double other_speed = 0.0;
    std::optional<std::uint32_t> person;
  };
  void touch(Time now, const Body& body, const Touching& touching);
  /// After the touches of one step: ends what no longer touches, returns the contacts that are ripe.
  [[nodiscard]] std::vector<docent_msgs::TrueContact> finish_step(Time now, double dt, const Body& body);

  /// [s] so far that something was touched and the wheels turned.
  [[nodiscard]] double seconds_wheels_turning() const { return wheels_turning_; }
  /// Someone carried the robot away.
  void forget();

 private:
  struct Approach {
    Time first{};  ///< in sight inside the stopping distance
    Time last{};
    bool has_braked = false;  ///< in time
  };
  struct Open {
    Time last{};
  };
  struct Pending {
    docent_msgs::TrueContact contact;
    std::optional<std::uint32_t> person;
    Time due{};
    bool was_braking = false;
  };
  std::map<std::uint32_t, Approach> approaches_;
  std::map<std::string, Open> open_;
  std::vector<Pending> pending_;
  int touches_ = 0;
  double wheels_turning_ = 0.0;
};

/// True when the person stands in what the robot sweeps, on the arc it is on, until it has stopped.
[[nodiscard]] bool is_inside_stopping_distance(const ContactLog::PersonSample& person, const Body& body);

}  // namespace docent::simulator
