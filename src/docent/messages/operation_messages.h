#pragma once

#include <cstdint>
#include <string>

#include "docent/messages/standard_messages.h"

// How the modules are and what staff allow.

namespace docent::docent_msgs {

/// What may change while running; latched.
struct Limits {
  static constexpr const char* kType = "docent_msgs/msg/Limits";
  double max_speed = 0.7;     ///< [m/s]
  double volume = 1;          ///< 0..1
  std::string mode = "open";  ///< open, web, closed; hours: what the museum's hours say
  bool is_open = true;        ///< takes requests
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("max_speed", m.max_speed);
    v("volume", m.volume);
    v("mode", m.mode);
    v("is_open", m.is_open);
  }
};

/// An operator steers by hand, through the collision avoidance; from web at 10 Hz as long as they hold the lease.
struct Steering {
  static constexpr const char* kType = "docent_msgs/msg/Steering";
  std_msgs::Header header;
  std::string by;           ///< the operator's name
  bool is_pressed = false;  ///< the dead man's switch: they hold it down
  double forward = 0;       ///< -1..1, share of the speed that the robot may drive; below 0: backwards
  double turn = 0;          ///< -1..1, to the left
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("by", m.by);
    v("is_pressed", m.is_pressed);
    v("forward", m.forward);
    v("turn", m.turn);
  }
};

/// What one of its keepers knows of the stop button; latched, and repeated. Of several keepers the one with the
/// greatest number is right; of equal numbers one that says stopped.
struct Stop {
  static constexpr const char* kType = "docent_msgs/msg/Stop";
  std_msgs::Header header;
  bool is_stopped = false;
  std::string by;            ///< the name of whoever pressed or released it last
  std::uint64_t number = 0;  ///< of all presses and releases; only grows
  bool is_sure = false;      ///< the keeper has asked the others since its start
  std::string keeper;        ///< the name of who says so
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("is_stopped", m.is_stopped);
    v("by", m.by);
    v("number", m.number);
    v("is_sure", m.is_sure);
    v("keeper", m.keeper);
  }
};

/// The museum has changed, or the robot shall work in the other one of the two: all modules begin anew.
struct MuseumMoved {
  static constexpr const char* kType = "docent_msgs/msg/MuseumMoved";
  std_msgs::Header header;
  bool is_trial = false;  ///< into the trial that operators have laid out; else into the museum itself
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("is_trial", m.is_trial);
  }
};

/// Life of a module, 2 Hz (architecture 10.10).
struct Health {
  static constexpr const char* kType = "docent_msgs/msg/Health";
  std_msgs::Header header;
  std::string module;
  std::string state;  ///< starting, ready, degraded, faulted
  std::string reason;
  std::int32_t pid = 0;
  double step_p99_ms = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("module", m.module);
    v("state", m.state);
    v("reason", m.reason);
    v("pid", m.pid);
    v("step_p99_ms", m.step_p99_ms);
  }
};

}  // namespace docent::docent_msgs
