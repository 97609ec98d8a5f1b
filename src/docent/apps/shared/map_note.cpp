#include "docent/apps/shared/map_note.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "docent/apps/shared/command.h"
#include "docent/apps/shared/log.h"
#include "docent/grid/map_classes.h"
#include "docent/museum/museum_loading.h"

namespace docent::apps {
namespace {

/// A line about a reading, which goes with it.
class ReadingLine {
 public:
  explicit ReadingLine(std::string path) : path_{std::move(path)} {}
  ReadingLine(const ReadingLine&) = delete;
  ReadingLine& operator=(const ReadingLine&) = delete;
  ~ReadingLine() {
    if (is_shown_) std::fputs(progress_.end().c_str(), stderr);
  }
  void tell(double done) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun_;
    if (!progress_.is_due(done, wall.count())) return;
    const std::string line = "reading " + path_ + ": " + std::to_string(std::lround(100.0 * done)) + " % of its rows";
    std::fputs(progress_.shown(line).c_str(), stderr);
    is_shown_ = true;
  }

 private:
  std::string path_;
  Progress progress_{::isatty(STDERR_FILENO) != 0};
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  bool is_shown_ = false;
};

}  // namespace

ReadingProgress reading_of(const std::string& path) {
  return [line = std::make_shared<ReadingLine>(path)](double done) { line->tell(done); };
}

void say_classes(const std::string& path, const OccupancyGrid& map, const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::fprintf(stderr, "note: %s: %s\n", path.c_str(), note.c_str());
  const MapClasses classes = classes_of(map);
  std::fprintf(stderr, "note: %s was read as %s\n", path.c_str(), classes.text().c_str());
  if (const std::string warning = classes.warning(); !warning.empty())
    std::fprintf(stderr, "warning: %s: %s\n", path.c_str(), warning.c_str());
}

OccupancyGrid load_and_say(const std::string& path) {
  LoadedMap loaded = value_or_fail(read_map(path, reading_of(path)));
  say_classes(path, loaded.map, loaded.notes);
  return std::move(loaded.map);
}

void say_map(const museum::Museum& museum) {
  if (!museum.map.cells.empty()) say_classes(museum.map_path.string(), museum.map, museum.map_notes);
}

museum::Museum load_museum_and_say(const std::string& folder) {
  museum::Museum museum = value_or_fail(museum::load_museum(folder, museum::Stage::complete, reading_of(folder)));
  say_map(museum);
  return museum;
}

}  // namespace docent::apps
