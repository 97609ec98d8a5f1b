#include "docent/apps/shared/map_note.h"

#include <cstdio>

#include "docent/apps/shared/command.h"
#include "docent/grid/map_classes.h"

namespace docent::apps {

void say_classes(const std::string& path, const OccupancyGrid& map, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s: %s\n", path.c_str(), note.c_str());
  const MapClasses classes = classes_of(map);
  std::fprintf(stderr, "note: %s was read as %s\n", path.c_str(), classes.text().c_str());
  if (const std::string warning = classes.warning(); !warning.empty())
    std::fprintf(stderr, "warning: %s: %s\n", path.c_str(), warning.c_str());
}

OccupancyGrid load_and_say(const std::string& path) {
  LoadedMap loaded = value_or_fail(read_map(path));
  say_classes(path, loaded.map, loaded.notes);
  return std::move(loaded.map);
}

void say_map(const museum::Museum& museum) {
  if (!museum.map.cells.empty()) say_classes(museum.map_path.string(), museum.map, museum.map_notes);
}

museum::Museum load_museum_and_say(const std::string& folder) {
  museum::Museum museum = value_or_fail(museum::load_museum(folder));
  say_map(museum);
  return museum;
}

}  // namespace docent::apps
