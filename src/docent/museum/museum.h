#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"

namespace docent {

/// A text in several languages: language code to text.
using Translations = std::map<std::string, std::string>;
/// The text in `language`, else in the first language that has one, else "".
[[nodiscard]] std::string translated(const Translations& texts, const std::string& language);

enum class HazardKind { glass, plate, stairs, other };
/// What sensors cannot see (architecture 5), as surveyed.
struct Hazard {
  std::string id;
  HazardKind kind = HazardKind::other;
  Polygon polygon;  ///< [m], map
};

struct Exhibit {
  std::string id;
  Translations title;
  Pose2 pose;      ///< map_from_base where the robot stands to show it
  Point2 look_at;  ///< what it points at
  std::vector<Pose2> viewpoints;
  Translations short_text;  ///< content of the files, not their names
  Translations long_text;
  std::vector<std::string> topics;
  bool web_only = false;
};

struct Mode {
  double max_speed = 0.7;  ///< [m/s]
  double wait_s = 0.0;
  std::vector<std::string> hours;
};

struct Tour {
  std::string id;
  Translations title;
  std::vector<std::string> exhibits;  ///< fixed order; empty for a composed tour
  std::optional<double> minutes;      ///< composed on the fly to last so long
};

/// A museum folder, read and validated (architecture 5). What the robot knows of the building; never the true world.
struct Museum {
  std::filesystem::path folder;
  Translations name;
  std::vector<std::string> languages;
  std::filesystem::path map_path;
  OccupancyGrid map;
  Polygon area;
  std::vector<Hazard> hazards;
  Pose2 home;
  std::optional<Pose2> charger;
  std::vector<Exhibit> exhibits;
  std::map<std::string, Mode> modes;
  std::vector<Tour> tours;
  std::optional<std::filesystem::path> simulation_path;

  [[nodiscard]] const Exhibit* find_exhibit(const std::string& id) const;
  [[nodiscard]] const Tour* find_tour(const std::string& id) const;
};

/// Reads FOLDER/museum.yaml with its map and texts. Error: the first fault, "FILE:LINE: …".
[[nodiscard]] Result<Museum> load_museum(const std::filesystem::path& folder);

/// Everything that cannot work in the museum: each fault with file, line and reason. Empty: the museum is fine.
[[nodiscard]] std::vector<Error> check_museum(const std::filesystem::path& folder);

}  // namespace docent
