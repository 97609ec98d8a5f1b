#include "docent/apps/shared/map_note.h"

#include <cstdio>

#include "docent/grid/map_classes.h"

namespace docent::apps {

void say_classes(const std::string& path, const OccupancyGrid& map) {
  const MapClasses classes = classes_of(map);
  std::fprintf(stderr, "note: %s was read as %s\n", path.c_str(), classes.text().c_str());
  if (const std::string warning = classes.warning(); !warning.empty())
    std::fprintf(stderr, "warning: %s: %s\n", path.c_str(), warning.c_str());
}

}  // namespace docent::apps
