#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Of documents.h: what those get who look inside the robot, and operators.

namespace docent::telepresence::documents {

struct MapPicture {
  static constexpr const char* kName = "MapPicture";
  std::string url;
  int columns = 0, rows = 0;
  double resolution = 0.0;
  std::array<double, 2> origin{};  ///< [m], the lower left corner
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("url", d.url), v("columns", d.columns), v("rows", d.rows), v("resolution", d.resolution), v("origin", d.origin);
  }
};
struct Raster {
  static constexpr const char* kName = "Raster";
  double x = 0.0, y = 0.0, cell = 0.0;
  int columns = 0, rows = 0;
  std::string levels;  ///< a byte a cell, base64
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("x", d.x), v("y", d.y), v("cell", d.cell), v("columns", d.columns), v("rows", d.rows), v("levels", d.levels);
  }
};
/// What the planner knows, for operators: how far it is to the goal from everywhere, and what stands in the building
/// now.
struct MapsMessage {
  static constexpr const char* kName = "MapsMessage";
  static constexpr const char* kType = "maps";
  Raster value;  ///< 255 at the goal, 1 farthest from it by cost, 0: no way from there; no columns: no goal
  Raster live;   ///< 255: occupied now; no columns: not known yet
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("value", d.value), v("live", d.live);
  }
};

/// How far a robot is that maps a building, for operators.
struct ExplorationMessage {
  static constexpr const char* kName = "ExplorationMessage";
  static constexpr const char* kType = "exploration";
  std::string state;  ///< starting, exploring, returning, mapping, done
  std::string order;  ///< wait, by_itself, by_hand, finish
  double known_m2 = 0.0, way_m = 0.0;
  std::uint32_t frontier = 0;                    ///< unknown cells that it can still go to
  std::vector<std::array<double, 2>> unreached;  ///< done: places that it could not get to or see into
  std::string warning;                           ///< done: why the map is not to be trusted; empty: it is
  std::optional<MapPicture> map;                 ///< as far as it is known
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("state", d.state), v("order", d.order), v("known_m2", d.known_m2), v("way_m", d.way_m);
    v("frontier", d.frontier), v("unreached", d.unreached), v("warning", d.warning), v("map", d.map);
  }
};

/// What the robot must not touch, and what it makes of its beams, for those who look inside. Frame of the robot.
struct FieldMessage {
  static constexpr const char* kName = "FieldMessage";
  static constexpr const char* kType = "field";
  std::vector<int> virtual_points;  ///< [cm] x, y, x, y … of virtual measurements: hazards and the area's border
  std::vector<int> beams;  ///< [cm] x, y, and where it comes from: 0 nobody knows, 1 the map, 2 and 3 not the map
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("virtual", d.virtual_points), v("beams", d.beams);
  }
};
struct LogLine {
  static constexpr const char* kName = "LogLine";
  double t = 0;
  std::string kind, subject, detail;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("kind", d.kind), v("subject", d.subject), v("detail", d.detail);
  }
};
/// What happened, the newest first, for those who look inside.
struct LogMessage {
  static constexpr const char* kName = "LogMessage";
  static constexpr const char* kType = "log";
  std::vector<LogLine> lines;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("lines", d.lines);
  }
};

/// Who operates the robot, for operators.
struct OperationMessage {
  static constexpr const char* kName = "OperationMessage";
  static constexpr const char* kType = "operation";
  std::string holder;       ///< of the lease to steer; empty: nobody
  bool is_pressed = false;  ///< they hold the dead man's switch down
  bool is_stopped = false;  ///< by the stop button
  std::string stopped_by;   ///< whoever pressed or released it last
  int stop_number = 0;      ///< of all presses and releases; a release names it
  std::string hours;        ///< what an operator has said of the hours last: open, web, closed, hours; empty: nothing
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("holder", d.holder), v("pressed", d.is_pressed), v("stopped", d.is_stopped), v("stopped_by", d.stopped_by);
    v("stop_number", d.stop_number);
    v("hours", d.hours);
  }
};

struct ModuleState {
  static constexpr const char* kName = "ModuleState";
  std::string name, state, reason;
  std::optional<double> p99_ms;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("name", d.name), v("state", d.state), v("reason", d.reason), v("p99_ms", d.p99_ms);
  }
};
struct HealthMessage {
  static constexpr const char* kName = "HealthMessage";
  static constexpr const char* kType = "health";
  std::size_t viewers = 0;
  std::vector<ModuleState> modules;
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("viewers", d.viewers), v("modules", d.modules);
  }
};
struct WindowMessage {
  static constexpr const char* kName = "WindowMessage";
  static constexpr const char* kType = "window";
  double v = 0.0, w = 0.0;
  std::vector<double> candidates;  ///< v, w, value, v, w, value …
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("v", d.v), v("w", d.w), v("candidates", d.candidates);
  }
};

}  // namespace docent::telepresence::documents
