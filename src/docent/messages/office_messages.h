#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// Missions in an office: deliveries and tidying up, and the things that the robot's eyes know.

namespace docent::docent_msgs {

/// Something that lies on the floor, where the robot's eyes have put it together of several looks.
struct SeenThing {
  static constexpr const char* kType = "docent_msgs/msg/SeenThing";
  std::uint32_t id = 0;
  std::string object;  ///< what it is, by the object book; empty: nobody taught it, or it is not sure yet
  double x = 0;        ///< [m], map, of its middle
  double y = 0;
  double covariance_xx = 0;  ///< [m²]
  double covariance_xy = 0;
  double covariance_yy = 0;
  double width = 0;         ///< [m]
  double height = 0;        ///< [m]
  std::uint32_t looks = 0;  ///< pictures in which it was seen
  std::uint32_t known = 0;  ///< of these it was known as `object` in so many
  builtin_interfaces::Time last;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("object", m.object);
    v("x", m.x);
    v("y", m.y);
    v("covariance_xx", m.covariance_xx);
    v("covariance_xy", m.covariance_xy);
    v("covariance_yy", m.covariance_yy);
    v("width", m.width);
    v("height", m.height);
    v("looks", m.looks);
    v("known", m.known);
    v("last", m.last);
  }
};

/// All things that are remembered; latched.
struct SeenThings {
  static constexpr const char* kType = "docent_msgs/msg/SeenThings";
  std_msgs::Header header;  ///< frame map; of the last picture that was looked at
  std::vector<SeenThing> things;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("things", m.things);
  }
};

/// What somebody wants of the robot in an office.
struct OfficeOrder {
  static constexpr const char* kType = "docent_msgs/msg/OfficeOrder";
  std::string id;      ///< of the order: the same again is the same one
  std::string kind;    ///< deliver, tidy, confirm, stop
  std::string room;    ///< for deliver: its id; for tidy: one room, or empty for all
  std::string source;  ///< web, kiosk, visitor, staff
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("kind", m.kind);
    v("room", m.room);
    v("source", m.source);
  }
};

/// How an order goes; latched, the single writer is office.
struct OfficeState {
  static constexpr const char* kType = "docent_msgs/msg/OfficeState";
  std_msgs::Header header;
  std::string order;  ///< id; empty: there was none yet
  std::string kind;
  std::string phase;    ///< idle, driving, handing_over, looking, approaching, asking, to_bin, emptying, done, failed
  std::string room;     ///< of a delivery
  std::string reason;   ///< why it failed, in English
  bool points = false;  ///< the head points at a thing
  double x = 0;         ///< [m], map: there
  double y = 0;
  std::uint32_t found = 0;      ///< things to tidy up that it was sure of
  std::uint32_t picked_up = 0;  ///< of these somebody has put into its bin
  std::uint32_t left = 0;       ///< nobody has
  std::uint32_t in_bin = 0;     ///< now
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("order", m.order);
    v("kind", m.kind);
    v("phase", m.phase);
    v("room", m.room);
    v("reason", m.reason);
    v("points", m.points);
    v("x", m.x);
    v("y", m.y);
    v("found", m.found);
    v("picked_up", m.picked_up);
    v("left", m.left);
    v("in_bin", m.in_bin);
  }
};

}  // namespace docent::docent_msgs
