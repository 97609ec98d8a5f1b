#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// A place where a robot may stop, and what it shows there.
struct Stop {
  std::string id;
  Pose2 pose;                                ///< world_from_base, facing what it shows
  Point2 look_at;                            ///< [m], world
  std::map<std::string, std::string> title;  ///< by language; empty: the id
  std::map<std::string, std::string> text;   ///< by language; empty: a sentence made of the id
};

/// What a person says of a building, each thing once: stops, hazards, home and charger. `docent museum --places` makes
/// museum.yaml, simulation.yaml and the texts of it.
struct Places {
  std::vector<std::string> languages{"en"};
  std::vector<Stop> stops;
  std::vector<Solid> hazards;  ///< what no laser sees, as things of the world
  std::optional<Pose2> home;   ///< world_from_base; absent: one is found
  std::optional<Pose2> charger;
};

/// Reads a file of places, written as in museum.yaml, with the texts in place of their files:
///
///     languages: [en]
///     home: {x: 1, y: 2, heading: 90}
///     charger: {x: 1, y: 1, heading: 0}
///     exhibits:
///       - {id: engine, title: {en: "The engine"}, text: {en: "It drove a mill."}, pose: {x: 3, y: 4, heading: 0},
///       look_at: {x: 4, y: 4}}
///     hazards:
///       - {id: steps, kind: stairs, polygon: [[5, 5], [6, 5], [6, 7]]}     # glass, plate, stairs, other
///
/// Faults name file and line.
[[nodiscard]] Result<Places> load_places(const std::filesystem::path& path);

}  // namespace docent::simulator
