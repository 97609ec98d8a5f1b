#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "docent/messages/standard_messages.h"

// People around the robot, and the beams that ended on them.

namespace docent::docent_msgs {

/// Endpoints of beams that the filters found too short for the map: people and other unmapped things. And the whole
/// sweep that they are of, with what the map says of each beam, so that people can be followed where it says nothing.
struct PersonBeams {
  static constexpr const char* kType = "docent_msgs/msg/PersonBeams";
  std_msgs::Header header;                ///< frame base_link
  std::vector<float> x;                   ///< [m]
  std::vector<float> y;                   ///< [m]
  std::array<double, 3> map_from_base{};  ///< best pose at the stamp: x, y [m], theta [rad]
  bool localized = false;
  std::array<double, 3> odom_from_base{};  ///< at the stamp
  std::vector<float> bearings;             ///< [rad] of all valid beams, base_link
  std::vector<float> ranges;               ///< [m] from base_link; negative: as far at least, nothing came back
  std::vector<std::uint8_t> origins;       ///< 0 nobody knows, 1 the map, 2 likely not the map, 3 surely not the map
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("x", m.x);
    v("y", m.y);
    v("map_from_base", m.map_from_base);
    v("localized", m.localized);
    v("odom_from_base", m.odom_from_base);
    v("bearings", m.bearings);
    v("ranges", m.ranges);
    v("origins", m.origins);
  }
};

/// A tracked person.
struct Person {
  static constexpr const char* kType = "docent_msgs/msg/Person";
  std::uint32_t id = 0;
  float x = 0;  ///< [m], map or odom: see the header of People
  float y = 0;
  float vx = 0;  ///< [m/s]
  float vy = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("x", m.x);
    v("y", m.y);
    v("vx", m.vx);
    v("vy", m.vy);
  }
};

/// Tracked people.
struct People {
  static constexpr const char* kType = "docent_msgs/msg/People";
  std_msgs::Header header;  ///< frame map on docent/people, frame odom on docent/people_odom
  std::vector<Person> people;
  std::vector<std::uint32_t> groups;        ///< [people] the same number: they stand or walk together; 0: alone
  std::array<double, 3> frame_from_base{};  ///< the robot at the stamp, in the message's frame: x, y [m], theta [rad]
  bool localized = false;  ///< places in the map are known; without, `people` on docent/people is empty
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("people", m.people);
    v("groups", m.groups);
    v("frame_from_base", m.frame_from_base);
    v("localized", m.localized);
  }
};

}  // namespace docent::docent_msgs
