#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// Ground truth, for the evaluation alone: another DDS domain, one channel of a recording.

namespace docent::docent_msgs {

/// What was run; written once at the start of a recording.
struct RunInfo {
  static constexpr const char* kType = "docent_msgs/msg/RunInfo";
  std::string museum;
  std::string mode;
  std::uint64_t seed = 0;
  std::string crowd;
  std::string config_hash;
  std::string simd;
  std::string crippled;  ///< empty, or how the robot was crippled
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("museum", m.museum);
    v("mode", m.mode);
    v("seed", m.seed);
    v("crowd", m.crowd);
    v("config_hash", m.config_hash);
    v("simd", m.simd);
    v("crippled", m.crippled);
  }
};

/// Truth channel only.
struct TruePerson {
  static constexpr const char* kType = "docent_msgs/msg/TruePerson";
  std::uint32_t id = 0;
  float x = 0;  ///< [m], world
  float y = 0;
  float vx = 0;
  float vy = 0;
  float radius = 0;
  bool visible = false;  ///< within 10 m and in sight of a laser
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("x", m.x);
    v("y", m.y);
    v("vx", m.vx);
    v("vy", m.vy);
    v("radius", m.radius);
    v("visible", m.visible);
  }
};

/// Ground truth, 10 Hz. Only the evaluation reads it.
struct TrueState {
  static constexpr const char* kType = "docent_msgs/msg/TrueState";
  std_msgs::Header header;  ///< frame world = map
  double x = 0;
  double y = 0;
  double theta = 0;
  double linear = 0;      ///< [m/s]
  double angular = 0;     ///< [rad/s]
  double distance_m = 0;  ///< driven so far
  bool inside_area = true;
  double battery = 1;           ///< 0..1
  double nearest_person_m = 0;  ///< outline to outline
  double blocked_beams = 0;     ///< fraction of the last laser sweep that ended on people
  std::vector<TruePerson> people;
  double contact_seconds = 0;              ///< so far: time in which something was touched and the wheels turned
  std::uint32_t visitors = 0;              ///< different people so far
  std::vector<std::uint8_t> person_beams;  ///< [people] beams of the last sweep that ended on each, 255 or more as 255
  double nearest_solid_m = 0;              ///< from the outline to the nearest wall, furniture or hazard
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("linear", m.linear);
    v("angular", m.angular);
    v("distance_m", m.distance_m);
    v("inside_area", m.inside_area);
    v("battery", m.battery);
    v("nearest_person_m", m.nearest_person_m);
    v("blocked_beams", m.blocked_beams);
    v("people", m.people);
    v("contact_seconds", m.contact_seconds);
    v("visitors", m.visitors);
    v("person_beams", m.person_beams);
    v("nearest_solid_m", m.nearest_solid_m);
  }
};

/// Ground truth of one touch, at its begin (section 9 says which count).
struct TrueContact {
  static constexpr const char* kType = "docent_msgs/msg/TrueContact";
  std_msgs::Header header;
  std::string kind;  ///< people, furniture, walls, hazards
  std::string what;  ///< id of what was touched
  double x = 0;      ///< [m], world
  double y = 0;
  double robot_speed = 0;  ///< [m/s], the robot's own velocity towards the touched point
  double other_speed = 0;  ///< [m/s], of the touched person towards the robot
  double wheel_speed = 0;  ///< [m/s]
  bool braked_in_time =
      false;  ///< full braking had begun within 0.3 s of the person first being visible inside the stopping distance
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("kind", m.kind);
    v("what", m.what);
    v("x", m.x);
    v("y", m.y);
    v("robot_speed", m.robot_speed);
    v("other_speed", m.other_speed);
    v("wheel_speed", m.wheel_speed);
    v("braked_in_time", m.braked_in_time);
  }
};

/// A simulated visitor made a wish (exposure for the success rate), or a scenario event happened.
struct TrueOffer {
  static constexpr const char* kType = "docent_msgs/msg/TrueOffer";
  std_msgs::Header header;
  std::string kind;  ///< request, kidnap, fault, restart, ...
  std::string subject;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("kind", m.kind);
    v("subject", m.subject);
  }
};

}  // namespace docent::docent_msgs
