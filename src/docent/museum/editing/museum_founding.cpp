#include "docent/museum/editing/museum_founding.h"

#include <algorithm>
#include <limits>
#include <system_error>

#include "docent/base/files.h"
#include "docent/museum/blank_museum.h"
#include "docent/museum/editing/museum_text.h"
#include "docent/museum/languages.h"

namespace docent::museum {
namespace {

constexpr double kMargin = 0.5;            // [m] from the free floor to the border of the area, at most
constexpr double kUnknownReach = 200.0;    // [m] of the area to all sides, as long as nobody knows the building
constexpr int kMinutes = 15;               // of the tour
constexpr std::size_t kLongestName = 200;  // [bytes]
constexpr std::size_t kMostLanguages = 20;

Result<void> validate(const Founding& founding) {
  const std::string& name = founding.name;
  if (name.find_first_not_of(" \t\r\n") == std::string::npos) return fail("the museum needs a name");
  if (name.size() > kLongestName || !is_utf8(name)) return fail("the museum's name is too long, or no UTF-8");
  const auto& languages = founding.languages;
  if (languages.empty()) return fail("the museum needs at least one language");
  if (languages.size() > kMostLanguages) return fail("too many languages");
  for (auto language = languages.begin(); language != languages.end(); ++language) {
    if (!is_language(*language)) return fail("'" + *language + "' is no language (two letters, such as en, de)");
    if (std::find(languages.begin(), language, *language) != language) return fail(*language + " stands twice");
  }
  return {};
}

/// All free cells, as a rectangle with some room; where there are none, all that a robot could ever reach.
Polygon area_of(const OccupancyGrid& map, Point2 home) {
  double margin = kUnknownReach;
  Point2 least = home;
  Point2 most = home;
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      if (!map.is_free({column, row})) continue;
      margin = kMargin;
      const Point2 place = map.frame.centre({column, row});
      least = {std::min(least.x, place.x), std::min(least.y, place.y)};
      most = {std::max(most.x, place.x), std::max(most.y, place.y)};
    }
  }
  least = {least.x - margin, least.y - margin};
  most = {most.x + margin, most.y + margin};
  return {least, {most.x, least.y}, most, {least.x, most.y}};
}

}  // namespace

Result<void> found_museum(const std::filesystem::path& folder, const Founding& founding) {
  if (auto valid = validate(founding); !valid) return valid;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(folder.string() + ": cannot be made: " + error.message());
  const OccupancyGrid map = founding.map.cells.empty() ? without_map({}, founding.home).map : founding.map;
  Translations name;
  for (const std::string& language : founding.languages) name[language] = founding.name;
  std::string languages;
  for (const std::string& language : founding.languages) languages += (languages.empty() ? "" : ", ") + language;
  std::string hazards = founding.hazards.empty() ? " []" : "";
  for (const Hazard& hazard : founding.hazards) hazards += "\n  - " + yaml_of(hazard);
  const std::string text =
      "# museum.yaml - metres and degrees in the map's frame. Begun by docent setup.\n"
      "name: " +
      yaml_of(name) +
      "\n"
      "languages: [" +
      languages +
      "]\n"
      "map: map.yaml\n"
      "area: " +
      yaml_of(area_of(map, founding.home.position())) +
      "\n"
      "hazards:" +
      hazards +
      "\n"
      "home: " +
      yaml_of(founding.home) +
      "\n"
      "exhibits: []\n"
      "tours:\n"
      "  - {id: tour, title: " +
      yaml_of(name) + ", minutes: " + std::to_string(kMinutes) + "}\n";
  if (auto before = read_file(folder / kMuseumFile)) {
    if (auto kept = write_file_atomically(folder / (std::string{kMuseumFile} + ".before"), *before); !kept) return kept;
  }
  if (auto saved = save_map(map, folder / "map"); !saved) return saved;
  return write_file_atomically(folder / kMuseumFile, text);
}

}  // namespace docent::museum
