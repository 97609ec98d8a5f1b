#pragma once

#include <cstdint>
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

/// How a thing looks that is more than a prism.
enum class SolidForm {
  prism,
  can,  ///< of soda, upright
  wad,  ///< of paper
  bin,  ///< for waste, open above
};

/// A thing of the true world: a prism over a polygon.
struct Solid {
  std::string id;
  SolidKind kind = SolidKind::wall;
  Polygon polygon;       ///< [m], world
  double bottom = 0.0;   ///< [m] above the floor
  double top = 3.0;      ///< [m]
  bool movable = false;  ///< furniture that someone may have moved since the survey
  SolidForm form = SolidForm::prism;
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

enum class CeilingKind {
  various,   ///< panels, plaster, beams, skylights and lamps, nowhere twice the same
  periodic,  ///< the same panel and lamp again and again: nobody can tell one place from the next
  plain,     ///< nothing to see at all
};

/// What cameras see overhead.
struct CeilingStyle {
  CeilingKind kind = CeilingKind::various;
  std::optional<std::uint64_t> seed;  ///< of what is drawn by chance; without: one that comes of the museum
};

/// A flat square with an AprilTag of the family 36h11, white round it, that sticks on something.
struct Mark {
  std::string id;
  int tag = 0;         ///< number in the family, 0..586
  Point2 position;     ///< [m], world, of its middle
  double height = 0;   ///< [m] above the floor, of its middle
  Angle heading;       ///< where it looks
  double tilt = 0.0;   ///< [rad] upwards: -pi/2 hangs under a ceiling and has its upper side towards `heading`
  double size = 0.16;  ///< [m] side of the black square
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
  CeilingStyle ceiling_style;
  std::vector<Mark> marks;
  std::optional<CameraPlace> scene_camera;
  std::string pedestrians_file;        ///< beside simulation.yaml; empty: nobody was recorded
  std::vector<Recording> pedestrians;  ///< recorded people who walk here, whatever the robot does

  [[nodiscard]] double ceiling_at(Point2 in_world) const;
};

/// Reads simulation.yaml. A solid's outline is written in one of four ways: `polygon: [[x, y], …]`,
/// `line: [[x, y], …]` with `thickness` (one solid a piece, ids "ID-1", "ID-2", …; `closed: true` joins the ends),
/// `box: {x, y, length, width, heading}` (centre, degrees) or `circle: {x, y, radius}` (a 16-gon). Besides the kinds
/// there are three forms, which are furniture: `can`, `wad` and `bin`. `pedestrians: FILE` names the recorded people
/// (pedestrians/tracks_file). Faults name file and line.
[[nodiscard]] Result<World> load_world(const std::filesystem::path& simulation_yaml);
/// From memory, without the recorded people; `name` stands where the file's name would.
[[nodiscard]] Result<World> parse_world(const std::string& text, const std::string& name);

[[nodiscard]] const char* to_string(SolidKind kind);
/// The kind as simulation.yaml names it: that of its form, if it has one.
[[nodiscard]] const char* kind_name(const Solid& solid);
[[nodiscard]] const char* to_string(CeilingKind kind);
/// Something that lies about and that nobody measures: a can, a wad.
[[nodiscard]] inline bool is_litter(const Solid& solid) {
  return solid.form == SolidForm::can || solid.form == SolidForm::wad;
}

/// Height [m] at which lasers look, and those of the sonars and of the infrared sensors.
inline constexpr double kLaserHeight = 0.38;
inline constexpr double kSonarHeight = 0.25;
inline constexpr double kInfraredHeight = 0.2;

/// True when a laser at kLaserHeight is reflected by the solid.
[[nodiscard]] bool is_seen_by_laser(const Solid& solid);

}  // namespace docent::simulator
