#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"
#include "docent/grid/clearance.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::museum {

/// A text in several languages: language code to text.
using Translations = std::map<std::string, std::string>;
/// The text in `language`, else in the first language that has one, else "".
[[nodiscard]] std::string translated(const Translations& texts, const std::string& language);

/// What a hazard is.
enum class HazardKind { glass, plate, stairs, other };
/// As museum.yaml has them.
[[nodiscard]] constexpr auto words_of(HazardKind) { return std::array{"glass", "plate", "stairs", "other"}; }
/// What sensors cannot see (architecture 5), as surveyed.
struct Hazard {
  std::string id;                       ///< unique
  HazardKind kind = HazardKind::other;  ///< what it is
  Polygon polygon;                      ///< [m], map
};

/// Where people can read on.
struct Link {
  Translations title;  ///< what the link says
  std::string url;     ///< http:// or https://
};

/// What the robot shows.
struct Exhibit {
  std::string id;                   ///< unique
  Translations title;               ///< its name
  Pose2 pose;                       ///< map_from_base where the robot stands to show it
  Point2 look_at;                   ///< what it points at
  std::vector<Pose2> viewpoints;    ///< other places to see it from, map_from_base
  Translations short_text;          ///< content of the files, not their names
  Translations long_text;           ///< for those who want to hear more
  std::vector<std::string> topics;  ///< what it is about
  bool web_only = false;            ///< the robot does not drive there
  std::filesystem::path picture;    ///< in the folder; screens show it on the way there; empty: none
  std::vector<Link> links;          ///< the page shows them
  /// Exhibits that make sense right after this one (ids). Empty: all that share a topic. See sensible_next.
  std::vector<std::string> next;
};

/// "HH:MM-HH:MM" of a day; hours that end before they begin run past midnight.
struct Hours {
  int from_minute = 0;  ///< since midnight, 0..1439
  int to_minute = 0;    ///< 1..1440
  /// The minute lies within.
  [[nodiscard]] bool holds(int minute_of_day) const;
};
/// Error: not "HH:MM-HH:MM".
[[nodiscard]] Result<Hours> parse_hours(const std::string& text);

/// Minute of the day, 0..1439. Error: not "HH:MM".
[[nodiscard]] Result<int> parse_clock(const std::string& text);

/// How the robot works in some hours.
struct Mode {
  double max_speed = 0.7;          ///< [m/s]
  double wait_s = 0.0;             ///< [s] at each exhibit, after the explanation, so that Web visitors can look round
  std::vector<std::string> hours;  ///< as parse_hours reads them
};

/// How the museum wants to hear the robot.
struct MuseumSound {
  std::optional<std::filesystem::path> music;  ///< WAV, Ogg or FLAC; without it Docent's own melody
  std::vector<std::string> quiet_hours;        ///< as parse_hours reads them
  double quiet_volume =
      0.3;  ///< 0..1 of the usual volume in the quiet hours; 10 dB less is about half as loud to the ear
};

/// A camera in the hall, on a mount that turns: the scene's camera.
struct SceneCamera {
  Point2 position;      ///< [m], map
  double height = 2.7;  ///< [m] above the floor
};

/// The names of modes: everybody, Web visitors alone, nobody but the staff.
inline constexpr std::array<const char*, 3> kModes{"open", "web", "closed"};

/// A tour that visitors can choose.
struct Tour {
  std::string id;                     ///< unique
  Translations title;                 ///< its name
  std::vector<std::string> exhibits;  ///< fixed order; empty for a composed tour
  std::optional<double> minutes;      ///< composed on the fly to last so long
  std::vector<int> daily{};           ///< [min] of the day, 0..1439, at which it begins by itself, rising
};

/// A room, or a part of a large one, as people call it. The robot knows rooms and doors from its map; this is what they
/// are called. Several names in one room divide it: what is nearest to walk to belongs to each.
struct Room {
  std::string id;     ///< no exhibit has it, either, and it is not "next"
  Translations name;  ///< what people call it
  Point2 at;          ///< [m], map: where the robot goes in it
};

/// A museum folder, read and validated (architecture 5). What the robot knows of the building; never the true world.
struct Museum {
  std::filesystem::path folder;                          ///< with museum.yaml
  Translations name;                                     ///< of the museum
  std::vector<std::string> languages;                    ///< codes, its own first
  std::filesystem::path map_path;                        ///< of the map's YAML
  OccupancyGrid map;                                     ///< walls
  std::vector<std::string> map_notes;                    ///< what is odd about the map's file
  Polygon area;                                          ///< [m], map: where the robot may be
  std::vector<Hazard> hazards;                           ///< what sensors do not see
  Pose2 home;                                            ///< map_from_base where it waits
  std::optional<Pose2> charger;                          ///< map_from_base before the charger
  std::vector<Exhibit> exhibits;                         ///< in the order of the file
  std::map<std::string, Mode> modes;                     ///< by name, see kModes
  std::vector<Tour> tours;                               ///< in the order of the file
  std::vector<Room> rooms;                               ///< names of rooms
  MuseumSound sound;                                     ///< music and quiet hours
  std::optional<SceneCamera> scene_camera;               ///< a camera in the hall
  std::optional<std::filesystem::path> simulation_path;  ///< of the simulated world

  [[nodiscard]] const Exhibit* find_exhibit(const std::string& id) const;  ///< null: there is none
  [[nodiscard]] std::vector<Polygon> hazard_polygons() const;              ///< [hazards] [m], map
  [[nodiscard]] const Tour* find_tour(const std::string& id) const;        ///< null: there is none
};

/// The exhibits that make sense right after `exhibit` (Minerva's "sensible pairs"): its `next` list, else those that
/// share a topic with it; never itself, never one that is only for the Web. In the order of museum.yaml.
[[nodiscard]] std::vector<const Exhibit*> sensible_next(const Museum& museum, const Exhibit& exhibit);
/// How many directed pairs (a, b) there are with b in sensible_next(a).
[[nodiscard]] std::size_t sensible_pairs(const Museum& museum);

/// The mode that the museum's hours say: web in the hours of `web`, closed in those of `closed`, else open. Where
/// `open` has hours, the museum is closed outside of all hours.
[[nodiscard]] std::string mode_at(const Museum& museum, int minute_of_day);

/// What the museum makes of the volume at this time of day, 0..1: 1 outside of its quiet hours.
[[nodiscard]] double volume_at(const Museum& museum, int minute_of_day);

/// How far a museum has come: one that is being set up has no exhibit yet.
enum class Stage { complete, being_set_up };

/// Reads FOLDER/museum.yaml with its map and texts. Error: the first fault, "FILE:LINE: …". Looks at the file's form,
/// ids, texts, polygons, modes and tours; whether the robot fits where it must stand is check_museum's question.
[[nodiscard]] Result<Museum> load_museum(const std::filesystem::path& folder, Stage stage = Stage::complete);

/// The robot that a museum is checked for, as its planner takes it.
struct CheckedRobot {
  double radius = 0.265;  ///< [m] of the disc
  Clearance clearance;    ///< that a place and a way must leave
  int coarsening = 3;     ///< map cells to a planning cell
};

/// Everything that cannot work in the museum: each fault with file, line and reason. Empty: the museum is fine.
/// The robot must reach each exhibit, viewpoint and the charger from home on the map's free cells, inside the area,
/// clear of walls and hazards. O(cells).
[[nodiscard]] std::vector<Error> check_museum(const std::filesystem::path& folder, const CheckedRobot& robot = {},
                                              Stage stage = Stage::complete);

}  // namespace docent::museum
