#include "docent/apps/laboratory/rooms/rooms_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "docent/pictures/map_picture.h"

namespace docent::apps::rooms_command {
namespace {

/// Across the way through a door, from one jamb to the other. Both ends are its middle where the map shows no such way.
std::vector<Point2> across(const mapping::Gap& gap, const mapping::Regions& regions) {
  constexpr double kNear = 0.7;  // [m] of it the places on both sides are looked at
  const CellIndex middle = regions.frame.cell_at(gap.at);
  const int reach = static_cast<int>(kNear / regions.frame.resolution);
  Point2 first{}, second{};
  int of_first = 0, of_second = 0;
  for (int row = middle.row - reach; row <= middle.row + reach; ++row) {
    for (int column = middle.column - reach; column <= middle.column + reach; ++column) {
      const CellIndex cell{column, row};
      if (!regions.frame.holds(cell)) continue;
      const int region = regions.of[regions.frame.index(cell)];
      if (region != gap.first && region != gap.second) continue;
      const Point2 at = regions.frame.centre(cell);
      if (distance(at, gap.at) > kNear) continue;
      (region == gap.first ? first : second) = (region == gap.first ? first : second) + at;
      ++(region == gap.first ? of_first : of_second);
    }
  }
  if (of_first == 0 || of_second == 0) return {gap.at, gap.at};
  const Point2 through = (1.0 / of_second) * second - (1.0 / of_first) * first;
  const double length = norm(through);
  if (length < 1e-6) return {gap.at, gap.at};
  const Point2 half = (0.5 * gap.width / length) * Point2{-through.y, through.x};
  return {gap.at - half, gap.at + half};
}

}  // namespace

pictures::Figure draw_rooms(const OccupancyGrid& map, const mapping::TopologicalMap& rooms) {
  static constexpr pictures::Color kHallway{250, 205, 70, 110};
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
    pictures::draw_path(axes, across(gap, rooms.regions), 2.5, kDoor);
    pictures::draw_points(axes, std::vector<Point2>{gap.at}, 2.5, kDoor);
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
  figure.add_legend(pictures::legend_line("door, from jamb to jamb", 2.5, kDoor));
  return figure;
}

}  // namespace docent::apps::rooms_command
