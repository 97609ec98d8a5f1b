#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"

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
};

/// Faults name file and line.
[[nodiscard]] Result<World> load_world(const std::filesystem::path& simulation_yaml);

}  // namespace docent::simulator
