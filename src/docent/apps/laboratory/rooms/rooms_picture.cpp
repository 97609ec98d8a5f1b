#include "docent/apps/laboratory/rooms/rooms_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "docent/pictures/map_picture.h"

namespace docent::apps::rooms_command {

pictures::Figure draw_rooms(const OccupancyGrid& map, const mapping::TopologicalMap& rooms) {
  static constexpr pictures::Color kHallway{150, 150, 150, 110};
  constexpr pictures::Color kDoor{200, 30, 30, 255};
  const auto count = [&rooms](mapping::PlaceKind kind) {
    return std::count_if(rooms.places.begin(), rooms.places.end(),
                         [kind](const mapping::Place& place) { return place.kind == kind; });
  };
  pictures::Figure figure{"Rooms (" + std::to_string(count(mapping::PlaceKind::room)) + "), hallways (" +
                          std::to_string(count(mapping::PlaceKind::hallway)) + ") and doors (" +
                          std::to_string(rooms.regions.gaps.size()) + ")"};
  pictures::Axes& axes = figure.add(pictures::Axes::metres(map.frame, 720.0));
  pictures::draw_map(axes, map);
  std::vector<float> values;
  for (const int region : rooms.regions.of)
    values.push_back(region == mapping::Regions::kNone ? std::numeric_limits<float>::quiet_NaN()
                                                       : static_cast<float>(region));
  pictures::draw_cells(axes, map.frame, values, [&rooms](float region) {
    const auto place = static_cast<std::size_t>(std::lround(region));
    return rooms.places[place].kind == mapping::PlaceKind::hallway
               ? kHallway
               : pictures::with_alpha(pictures::distinct(static_cast<int>(place)), 110);
  });
  for (const mapping::Gap& gap : rooms.regions.gaps) {
    const Point2 from = rooms.places[static_cast<std::size_t>(gap.first)].middle;
    const Point2 to = rooms.places[static_cast<std::size_t>(gap.second)].middle;
    pictures::draw_path(axes, std::vector<Point2>{from, gap.at, to}, 0.8, pictures::with_alpha(kDoor, 120));
    pictures::draw_points(axes, std::vector<Point2>{gap.at}, 5.0, kDoor);
  }
  std::vector<Point2> middles;
  for (const mapping::Place& place : rooms.places) middles.push_back(axes.page(place.middle));
  axes.add([middles](pictures::Canvas& canvas) {
    for (std::size_t i = 0; i < middles.size(); ++i)
      canvas.draw_label(middles[i], std::to_string(i + 1), {.size = 8.0, .anchor = {0.5, 0.5}}, {255, 255, 255, 180});
  });
  pictures::add_map_legend(figure);
  figure.add_legend(pictures::legend_area("hallway", kHallway));
  figure.add_legend(pictures::legend_area("rooms", pictures::with_alpha(pictures::distinct(0), 110)));
  figure.add_legend(pictures::legend_disc("door, and what it joins", 5.0, kDoor));
  return figure;
}

}  // namespace docent::apps::rooms_command
