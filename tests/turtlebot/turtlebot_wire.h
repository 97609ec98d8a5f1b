#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "turtlebot_body.h"

namespace docent::turtlebot {

/// How services go over the wire.
enum class Rmw {
  cyclonedds,  ///< a header of 16 bytes before each request, which goes back with the reply
  fastrtps,    ///< none
};

struct WireSettings {
  int domain = 0;
  bool stamped_commands = true;
  Rmw rmw = Rmw::cyclonedds;
  std::string scan_topic = "scan";
  bool offers_actions = true;
};

/// A TurtleBot 4 on the wire: its topics and its two actions, with Cyclone DDS's own serializer. It runs on a thread of
/// its own until it is destroyed.
class Turtlebot {
 public:
  Turtlebot(const Settings& settings, const WireSettings& wire);
  Turtlebot(const Turtlebot&) = delete;
  Turtlebot& operator=(const Turtlebot&) = delete;
  ~Turtlebot();

  /// Looks at the body, or changes it, between two of its steps.
  template <class F>
  auto with_body(F&& f) {
    const std::scoped_lock lock{mutex_};
    return f(body_);
  }
  /// That it has taken; and those that it has refused.
  [[nodiscard]] std::pair<int, int> goals() {
    const std::scoped_lock lock{mutex_};
    return {goals_taken_, goals_refused_};
  }
  /// It publishes no hazards any more.
  void silence_hazards() {
    const std::scoped_lock lock{mutex_};
    says_hazards_ = false;
  }

 private:
  using GoalId = std::array<std::uint8_t, 16>;
  struct Action {
    std::string name;  ///< dock, undock
    std::int32_t requests = 0, replies = 0, status = 0;
    std::vector<std::pair<GoalId, std::uint8_t>> goals{};
  };
  void open(const WireSettings& wire);
  void open_action(Action& action);
  void run(const std::stop_token& stop);
  void hear_commands();
  void hear_goals(Action& action);
  void end_goals();
  void say(std::int64_t tick);
  void say_scan();
  void say_odometry();
  void say_hazards();
  void say_battery();
  void say_dock();
  void say_goals(Action& action);

  std::mutex mutex_;
  Body body_;
  WireSettings wire_;
  bool says_hazards_ = true;
  int goals_taken_ = 0, goals_refused_ = 0;
  std::int32_t participant_ = 0, own_domain_ = 0;
  std::map<std::string, std::int32_t> writers_;
  std::int32_t commands_ = 0;
  Action dock_{.name = "dock"}, undock_{.name = "undock"};
  std::jthread thread_;
};

}  // namespace docent::turtlebot
