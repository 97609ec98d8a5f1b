#include "docent/apps/laboratory/rooms/rooms_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "docent/apps/laboratory/rooms/rooms_picture.h"
#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/map_note.h"
#include "docent/base/files.h"
#include "docent/mapping/rooms/room_graph.h"
#include "docent/mapping/topological/topological_map.h"
#include "docent/museum/museum.h"

namespace docent::apps::rooms_command {
namespace {

struct RoomsOptions {
  std::string map;
  std::string museum;
  std::string picture;
  std::string report;
  std::string cells;
  mapping::RegionParams params;
};

const char* name_of(mapping::PlaceKind kind) { return kind == mapping::PlaceKind::hallway ? "hallway" : "room"; }

nlohmann::json report_of(const mapping::TopologicalMap& rooms) {
  nlohmann::json places = nlohmann::json::array(), doors = nlohmann::json::array();
  for (std::size_t i = 0; i < rooms.places.size(); ++i) {
    const mapping::Place& place = rooms.places[i];
    std::vector<int> next = rooms.neighbours(static_cast<int>(i));
    for (int& number : next) ++number;
    places.push_back({{"number", i + 1},
                      {"kind", name_of(place.kind)},
                      {"area_m2", place.shape.area},
                      {"width_m", place.shape.width},
                      {"elongation", place.shape.elongation},
                      {"doors", place.shape.doors},
                      {"x", place.middle.x},
                      {"y", place.middle.y},
                      {"next_to", next}});
  }
  for (const mapping::Gap& gap : rooms.regions.gaps)
    doors.push_back(
        {{"x", gap.at.x}, {"y", gap.at.y}, {"width_m", gap.width}, {"between", {gap.first + 1, gap.second + 1}}});
  return {{"places", places}, {"doors", doors}};
}

/// Portable grey map of 16 bits, as the map lies: the number of each cell's place, 0 for none.
std::string picture_of_cells(const mapping::Regions& regions) {
  std::string file =
      "P5\n" + std::to_string(regions.frame.columns) + " " + std::to_string(regions.frame.rows) + "\n65535\n";
  for (int row = regions.frame.rows - 1; row >= 0; --row) {
    for (int column = 0; column < regions.frame.columns; ++column) {
      const int number = 1 + regions.of[regions.frame.index({column, row})];
      file += static_cast<char>(number / 256);
      file += static_cast<char>(number % 256);
    }
  }
  return file;
}

/// The rooms of a museum with their names, in the order in which "go to the next room" takes them.
void list_rooms(const museum::Museum& museum, const mapping::RegionParams& params) {
  const mapping::RoomGraph graph = mapping::room_graph(museum, params);
  for (const mapping::Room& room : graph.rooms()) {
    const std::string name = museum.languages.empty() ? "" : museum::translated(room.name, museum.languages.front());
    std::printf("%-16s %-24s at (%.1f, %.1f)  leads to", room.id.c_str(), name.c_str(), room.at.x, room.at.y);
    for (const int other : room.next) std::printf(" %s", graph.rooms()[static_cast<std::size_t>(other)].id.c_str());
    std::printf("\n");
  }
  std::printf("%zu rooms, %zu doors between them\n", graph.rooms().size(), graph.doors().size());
}

void run(const RoomsOptions& options) {
  value_or_fail(options.params.validate());
  if (!options.museum.empty()) return list_rooms(load_museum_and_say(options.museum), options.params);
  const OccupancyGrid map = load_and_say(options.map);
  const mapping::TopologicalMap rooms = mapping::topological_map(map, options.params);
  for (std::size_t i = 0; i < rooms.places.size(); ++i) {
    const mapping::Place& place = rooms.places[i];
    std::printf("%3zu  %-7s  %6.1f m2  %4.1f m wide  at (%.1f, %.1f)  next to", i + 1, name_of(place.kind),
                place.shape.area, place.shape.width, place.middle.x, place.middle.y);
    for (const int other : rooms.neighbours(static_cast<int>(i))) std::printf(" %d", other + 1);
    std::printf("\n");
  }
  std::printf("%zu places, %zu doors and other narrow ways\n", rooms.places.size(), rooms.regions.gaps.size());
  if (!options.report.empty()) value_or_fail(write_file_atomically(options.report, report_of(rooms).dump(2) + "\n"));
  if (!options.cells.empty()) value_or_fail(write_file_atomically(options.cells, picture_of_cells(rooms.regions)));
  if (!options.picture.empty()) value_or_fail(draw_rooms(map, rooms).save(options.picture));
}

}  // namespace

void add_rooms_command(CLI::App& app) {
  auto* command = app.add_subcommand("rooms", "Rooms, hallways and doors of a map");
  auto options = std::make_shared<RoomsOptions>();
  auto* source = command->add_option_group("source", "Whose rooms");
  source->add_option("--map", options->map, "map_server YAML file");
  auto* museum = source->add_option("--museum", options->museum,
                                    "Museum folder: its rooms by their names, in the order of \"the next room\"");
  source->require_option(1);
  command->add_option("--picture", options->picture, "SVG, PDF or PNG file to write")
      ->check(output_file())
      ->excludes(museum);
  command->add_option("--report", options->report, "JSON file to write: places, doors, and what is next to what")
      ->check(output_file())
      ->excludes(museum);
  command->add_option("--cells", options->cells, "PGM file of 16 bits to write: the number of each cell's place")
      ->check(output_file())
      ->excludes(museum);
  command->add_option("--door", options->params.door, "[m] what is wider is no door")->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace docent::apps::rooms_command
