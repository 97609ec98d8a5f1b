#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/simulator/pedestrians/track.h"

namespace docent::simulator {

enum class SolidKind {
  wall,       ///< up to the ceiling
  furniture,  ///< cases, podiums, benches, machines: seen by what reaches their height
  glass,      ///< touches like a wall; a laser looks through it, sonar may see it
  plate,      ///< lies on the floor or hangs above: touches, but no sensor meets it
  stairs,     ///< going down: nothing to see; driving over the edge is a fall
};

/// A thing of the true world: a prism over a polygon.
struct Solid {
  std::string id;
  SolidKind kind = SolidKind::wall;
  Polygon polygon;       ///< [m], world
  double bottom = 0.0;   ///< [m] above the floor
  double top = 3.0;      ///< [m]
  bool movable = false;  ///< furniture that someone may have moved since the survey
};

/// Where people like to be: an exhibit, a bench, the entrance.
struct Attraction {
  std::string id;
  Point2 centre;        ///< [m], world: what they look at
  double radius = 1.5;  ///< [m]: they stand about so far from it
  double weight = 1.0;  ///< how often it is chosen
};

/// A part of the hall with a ceiling of its own height.
struct CeilingPart {
  Polygon polygon;      ///< [m], world
  double height = 3.0;  ///< [m] above the floor
};

/// A camera that hangs in the hall.
struct CameraPlace {
  Point2 position;      ///< [m], world
  double height = 2.7;  ///< [m] above the floor
};

/// The true museum (simulation.yaml). Read by the simulator, the evaluation's tools and nothing else
/// (architecture 10.1).
struct World {
  std::vector<Solid> solids;
  Polygon floor;           ///< where people may walk, before solids are taken out
  Polygon operating_area;  ///< leaving it is an area violation
  std::vector<Attraction> attractions;
  std::vector<Point2> entrances;      ///< people come and go here
  Point2 home{};                      ///< visitors who want a tour wait near it
  double visitors_per_hour = 24.0;    ///< who ask the robot for something
  std::vector<std::string> exhibits;  ///< ids that they may ask for
  std::vector<std::string> tours;
  double ceiling_height = 3.0;       ///< [m], where no part says otherwise
  std::vector<CeilingPart> ceiling;  ///< the last part that holds a point counts
  std::optional<CameraPlace> scene_camera;
  std::string pedestrians_file;        ///< beside simulation.yaml; empty: nobody was recorded
  std::vector<Recording> pedestrians;  ///< recorded people who walk here, whatever the robot does

  [[nodiscard]] double ceiling_at(Point2 in_world) const;
};

/// Reads simulation.yaml. A solid's outline is written in one of four ways: `polygon: [[x, y], …]`,
/// `line: [[x, y], …]` with `thickness` (one solid a piece, ids "ID-1", "ID-2", …; `closed: true` joins the ends),
/// `box: {x, y, length, width, heading}` (centre, degrees) or `circle: {x, y, radius}` (a 16-gon).
/// `pedestrians: FILE` names the recorded people (pedestrians/tracks_file). Faults name file and line.
[[nodiscard]] Result<World> load_world(const std::filesystem::path& simulation_yaml);
/// From memory, without the recorded people; `name` stands where the file's name would.
[[nodiscard]] Result<World> parse_world(const std::string& text, const std::string& name);

[[nodiscard]] const char* to_string(SolidKind kind);

/// Height [m] at which lasers look, and those of the sonars and of the infrared sensors.
inline constexpr double kLaserHeight = 0.38;
inline constexpr double kSonarHeight = 0.25;
inline constexpr double kInfraredHeight = 0.2;

/// True when a laser at kLaserHeight is reflected by the solid.
[[nodiscard]] bool is_seen_by_laser(const Solid& solid);

}  // namespace docent::simulator
