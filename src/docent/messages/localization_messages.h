#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// Where the robot may be, and how the map changes while it looks.

namespace docent::docent_msgs {

/// One entry of the position probability grid: the centre of a cell and its mass.
struct BeliefCell {
  static constexpr const char* kType = "docent_msgs/msg/BeliefCell";
  float x = 0;  ///< [m], map
  float y = 0;
  float theta = 0;  ///< [rad]
  float mass = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("mass", m.mass);
  }
};

/// What the listed cells leave out, on a coarse grid in x and y, all headings together; every heading of such a cell is
/// possible.
struct CoarseBelief {
  static constexpr const char* kType = "docent_msgs/msg/CoarseBelief";
  float origin_x = 0;  ///< [m], lower left
  float origin_y = 0;
  float cell_size = 0;  ///< [m]
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  std::vector<float> mass;  ///< [rows * columns]
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("origin_x", m.origin_x);
    v("origin_y", m.origin_y);
    v("cell_size", m.cell_size);
    v("columns", m.columns);
    v("rows", m.rows);
    v("mass", m.mass);
  }
};

/// One mode of the belief.
struct Hypothesis {
  static constexpr const char* kType = "docent_msgs/msg/Hypothesis";
  double x = 0;  ///< [m], map
  double y = 0;
  double theta = 0;                    ///< [rad]
  std::array<double, 9> covariance{};  ///< row-major x, y, theta
  double mass = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("covariance", m.covariance);
    v("mass", m.mass);
  }
};

/// Where the robot may be (architecture 10.5): at most 8,192 cells with at least 99.5 % of the mass, the rest coarse.
struct Belief {
  static constexpr const char* kType = "docent_msgs/msg/Belief";
  std_msgs::Header header;  ///< frame map; stamp of the scan it includes
  std::string map_hash;
  float cell_size = 0;     ///< [m]
  float heading_step = 0;  ///< [rad]
  std::vector<BeliefCell> cells;
  CoarseBelief rest;
  std::vector<Hypothesis> hypotheses;  ///< by falling mass
  double entropy = 0;                  ///< [nat]
  double p_lost = 1;                   ///< probability that the best hypothesis is wrong
  bool localized = false;              ///< false: "I do not know"
  double active_mass = 1;              ///< mass of the cells that are updated
  std::uint32_t active_cells = 0;
  std::uint32_t beams_used = 0;
  std::uint32_t beams_filtered = 0;
  geometry_msgs::Pose odom_pose;  ///< odom_from_base at the stamp, so that others can carry the belief forward
  float agreement = 0;            ///< 0..1: share of the readings that the map explains, lately
  float contradiction = 0;        ///< 0..1: share of the readings that pass through walls of the map, lately
  float surprise = 0;             ///< the same, in the last sweep alone, against the best hypothesis
  float hidden = 0;               ///< 0..1: share of the last sweep that is too short, more than lately
  float confirmation = 0;         ///< 0..1: of the updates and the motion that it takes to say "here"
  float blind_way = 0;            ///< [m] driven since readings last agreed with the map
  float unmapped = 0;             ///< 0..1: share of the straight walls in sight that the map lacks, lately
  float share = 1;                ///< 0..1: of the best mode among the places that the whole way leaves possible
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("map_hash", m.map_hash);
    v("cell_size", m.cell_size);
    v("heading_step", m.heading_step);
    v("cells", m.cells);
    v("rest", m.rest);
    v("hypotheses", m.hypotheses);
    v("entropy", m.entropy);
    v("p_lost", m.p_lost);
    v("localized", m.localized);
    v("active_mass", m.active_mass);
    v("active_cells", m.active_cells);
    v("beams_used", m.beams_used);
    v("beams_filtered", m.beams_filtered);
    v("odom_pose", m.odom_pose);
    v("agreement", m.agreement);
    v("contradiction", m.contradiction);
    v("surprise", m.surprise);
    v("hidden", m.hidden);
    v("confirmation", m.confirmation);
    v("blind_way", m.blind_way);
    v("unmapped", m.unmapped);
    v("share", m.share);
  }
};

/// A fix: where another sensor than the lasers finds the robot by itself. Sent with each picture or reading that says
/// anything.
struct PoseFix {
  static constexpr const char* kType = "docent_msgs/msg/PoseFix";
  std_msgs::Header header;  ///< frame map; when the picture was taken
  std::string source;       ///< which sensor: ceiling
  double x = 0;             ///< [m], map
  double y = 0;
  double theta = 0;                    ///< [rad]
  std::array<double, 9> covariance{};  ///< row-major x, y, theta
  double p_wrong = 1;                  ///< probability that the robot is elsewhere
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("source", m.source);
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("covariance", m.covariance);
    v("p_wrong", m.p_wrong);
  }
};

/// A changed rectangle of the live map. It builds on the full map of stamp `base`; numbers count up from 1 behind each
/// full map. Who misses a number waits for the next full map, at most ten seconds.
struct LiveMapUpdate {
  static constexpr const char* kType = "docent_msgs/msg/LiveMapUpdate";
  std_msgs::Header header;
  builtin_interfaces::Time base;
  std::uint32_t number = 0;
  std::int32_t x = 0;  ///< [cells]
  std::int32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::int8_t> data;  ///< [height * width], 0..100 or -1
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("base", m.base);
    v("number", m.number);
    v("x", m.x);
    v("y", m.y);
    v("width", m.width);
    v("height", m.height);
    v("data", m.data);
  }
};

/// What a technician has a robot do that maps a building; latched.
struct ExplorationOrder {
  static constexpr const char* kType = "docent_msgs/msg/ExplorationOrder";
  std_msgs::Header header;
  std::string order;  ///< wait, by_itself, by_hand, finish (the map is made of what it has seen)
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("order", m.order);
  }
};

/// How far a robot is that maps a building by itself; latched.
struct Exploration {
  static constexpr const char* kType = "docent_msgs/msg/Exploration";
  std_msgs::Header header;
  std::string state;           ///< starting, exploring, returning, mapping (it computes and stands), done, stranded
  float known_m2 = 0;          ///< floor known to be free
  std::uint32_t frontier = 0;  ///< unknown cells that it can still go to
  float way_m = 0;             ///< driven
  std::uint32_t loops = 0;     ///< places recognised
  std::vector<double> unreached_x;  ///< [m], map: unknown places beside free floor that it could not get to or see into
  std::vector<double> unreached_y;  ///< [m]
  std::string map;                  ///< done: the file of the map
  std::string warning;              ///< done: why the map is not to be trusted; empty: it is
  std::string order;                ///< as it was taken last: wait, by_itself, by_hand, finish
  double mark_margin = 0;           ///< [m] that it keeps off what people have marked near it, beside other margins
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("state", m.state);
    v("known_m2", m.known_m2);
    v("frontier", m.frontier);
    v("way_m", m.way_m);
    v("loops", m.loops);
    v("unreached_x", m.unreached_x);
    v("unreached_y", m.unreached_y);
    v("map", m.map);
    v("warning", m.warning);
    v("order", m.order);
    v("mark_margin", m.mark_margin);
  }
};

}  // namespace docent::docent_msgs
