#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/museum.h"

namespace docent::museum {

/// All that is known of a museum in the beginning.
struct Founding {
  std::string name;                    ///< the same in all languages
  std::vector<std::string> languages;  ///< of ISO 639-1, each once
  Pose2 home;                          ///< where the robot stands
  std::vector<Hazard> hazards;         ///< that somebody has marked already
  OccupancyGrid map;                   ///< empty: there is none yet
};

/// Writes the folder of a museum that is being set up: no hazard, no exhibit, one tour that is composed on the way, and
/// all that the map shows as its area. What museum.yaml said before is kept as museum.yaml.before. Error: the name is
/// empty or no UTF-8, a language unknown, or the folder cannot be written.
[[nodiscard]] Result<void> found_museum(const std::filesystem::path& folder, const Founding& founding);

}  // namespace docent::museum
