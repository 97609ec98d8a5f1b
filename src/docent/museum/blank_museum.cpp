#include "docent/museum/blank_museum.h"

namespace docent::museum {

Museum without_map(const Museum& museum, const Pose2& start) {
  constexpr int kCells = 40;  // a map is never empty; these are unknown
  Museum blank;
  blank.folder = museum.folder;
  blank.name = museum.name;
  blank.languages = museum.languages;
  blank.area = museum.area;
  blank.hazards = museum.hazards;
  blank.home = start;
  blank.charger = museum.charger;
  blank.modes = museum.modes;
  blank.sound = museum.sound;
  blank.simulation_path = museum.simulation_path;
  blank.map.frame = {kCells, kCells, 0.05, {start.x - 0.025 * kCells, start.y - 0.025 * kCells}};
  blank.map.cells.assign(blank.map.frame.size(), OccupancyGrid::kUnknown);
  return blank;
}

}  // namespace docent::museum
