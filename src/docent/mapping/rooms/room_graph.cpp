#include "docent/mapping/rooms/room_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <set>
#include <utility>

namespace docent::mapping {
namespace {

constexpr double kNear = 1.5;  // [m] from the floor of a room, a point still belongs to it: beside a wall, in a niche

/// What the robot may drive on: hazards are taken as walls, what lies outside its area as unknown. O(cells hazards).
OccupancyGrid floor_of(const museum::Museum& museum) {
  OccupancyGrid map = museum.map;
  for (int row = 0; row < map.frame.rows; ++row) {
    for (int column = 0; column < map.frame.columns; ++column) {
      std::int8_t& cell = map.cells[map.frame.index({column, row})];
      if (cell == OccupancyGrid::kUnknown) continue;
      const Point2 at = map.frame.centre({column, row});
      if (!museum.area.empty() && !contains(museum.area, at)) cell = OccupancyGrid::kUnknown;
      for (const museum::Hazard& hazard : museum.hazards)
        if (contains(hazard.polygon, at)) cell = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

/// The cell nearest to a point that `wanted` takes, within kNear; nullopt: there is none.
template <class F>
std::optional<std::size_t> nearest_cell(const GridFrame& frame, Point2 point, F wanted) {
  const CellIndex middle = frame.cell_at(point);
  if (frame.holds(middle) && wanted(frame.index(middle))) return frame.index(middle);
  const int reach = static_cast<int>(kNear / frame.resolution);
  std::optional<std::size_t> best;
  double nearest = kNear;
  for (int row = std::max(0, middle.row - reach); row <= std::min(frame.rows - 1, middle.row + reach); ++row) {
    for (int column = std::max(0, middle.column - reach); column <= std::min(frame.columns - 1, middle.column + reach);
         ++column) {
      const double off = distance(frame.centre({column, row}), point);
      if (off >= nearest || !wanted(frame.index({column, row}))) continue;
      nearest = off;
      best = frame.index({column, row});
    }
  }
  return best;
}

/// Gives each cell of the floor the number of its room: of its place, or, where the museum names parts of it, of the
/// part to which the way within the place is shortest. Numbers are [names..., places without one...].
struct Division {
  std::vector<int> of;        ///< [cells] RoomGraph::kNone: none
  std::vector<int> place_of;  ///< [rooms] kNone: a name that lies on no floor
};

Division divide(const Regions& regions, const std::vector<museum::Room>& names) {
  constexpr int kNone = RoomGraph::kNone;
  const GridFrame& frame = regions.frame;
  Division result{std::vector<int>(frame.size(), kNone), std::vector<int>(names.size(), kNone)};
  using Front = std::pair<float, std::size_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> open;
  std::vector<float> way(frame.size(), std::numeric_limits<float>::infinity());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto cell = nearest_cell(frame, names[i].at, [&](std::size_t c) { return regions.of[c] != Regions::kNone; });
    if (!cell || way[*cell] == 0.0F) continue;
    result.place_of[i] = regions.of[*cell];
    result.of[*cell] = static_cast<int>(i);
    way[*cell] = 0.0F;
    open.emplace(0.0F, *cell);
  }
  while (!open.empty()) {
    const auto [so_far, from] = open.top();
    open.pop();
    if (so_far > way[from]) continue;
    const int columns = frame.columns;
    const CellIndex cell{static_cast<int>(from) % columns, static_cast<int>(from) / columns};
    for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
      for (int column = cell.column - 1; column <= cell.column + 1; ++column) {
        if (!frame.holds({column, row})) continue;
        const std::size_t to = frame.index({column, row});
        if (regions.of[to] != regions.of[from]) continue;
        const bool is_aslant = row != cell.row && column != cell.column;
        const float there = so_far + (is_aslant ? std::numbers::sqrt2_v<float> : 1.0F);
        if (there >= way[to]) continue;
        way[to] = there;
        result.of[to] = result.of[from];
        open.emplace(there, to);
      }
    }
  }
  std::vector<int> room_of_place(static_cast<std::size_t>(regions.count), kNone);
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (regions.of[i] == Regions::kNone || result.of[i] != kNone) continue;
    int& room = room_of_place[static_cast<std::size_t>(regions.of[i])];
    if (room == kNone) {
      room = static_cast<int>(result.place_of.size());
      result.place_of.push_back(regions.of[i]);
    }
    result.of[i] = room;
  }
  return result;
}

/// Two cells of different rooms that touch.
struct Touch {
  int first = 0, second = 0;  ///< rooms, ascending
  Point2 at;
};

std::vector<Touch> touches_of(const GridFrame& frame, const std::vector<int>& of) {
  std::vector<Touch> result;
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      const int here = of[frame.index({column, row})];
      for (const CellIndex beside : {CellIndex{column + 1, row}, CellIndex{column, row + 1}}) {
        if (here == RoomGraph::kNone || !frame.holds(beside)) continue;
        const int there = of[frame.index(beside)];
        if (there == RoomGraph::kNone || there == here) continue;
        result.push_back({std::min(here, there), std::max(here, there), frame.centre(beside)});
      }
    }
  }
  return result;
}

/// From the first room to the nearest one beside it that is still to come, and so on; back where none is.
std::vector<int> walk(int first, const std::vector<std::set<int>>& next, const std::vector<Point2>& at) {
  std::vector<int> order{first};
  std::vector<int> way{first};
  while (!way.empty()) {
    const int here = way.back();
    int best = RoomGraph::kNone;
    const auto from_here = [&](int room) {
      return distance(at[static_cast<std::size_t>(room)], at[static_cast<std::size_t>(here)]);
    };
    for (const int room : next[static_cast<std::size_t>(here)]) {
      if (std::find(order.begin(), order.end(), room) != order.end()) continue;
      if (best == RoomGraph::kNone || from_here(room) < from_here(best)) best = room;
    }
    if (best == RoomGraph::kNone) {
      way.pop_back();
    } else {
      order.push_back(best);
      way.push_back(best);
    }
  }
  return order;
}

/// Gives each room its id and name, or its number.
class Namer {
 public:
  explicit Namer(const museum::Museum& museum) : museum_{museum} {}
  /// @param number  as in Division
  void name(Room& room, std::size_t number) {
    if (number < museum_.rooms.size()) {
      room.id = museum_.rooms[number].id;
      room.name = museum_.rooms[number].name;
      return;
    }
    const bool is_hallway = room.kind == PlaceKind::hallway;
    room.number = ++without_name_[is_hallway ? 1 : 0];
    room.id = (is_hallway ? "hallway-" : "room-") + std::to_string(room.number);
    const auto is_taken = [&](const museum::Room& other) { return other.id == room.id; };
    while (museum_.find_exhibit(room.id) != nullptr ||
           std::any_of(museum_.rooms.begin(), museum_.rooms.end(), is_taken))
      room.id += "-";
  }

 private:
  const museum::Museum& museum_;
  std::array<int, 2> without_name_{};
};

}  // namespace

int RoomGraph::room_at(Point2 point) const {
  const auto cell = nearest_cell(frame_, point, [&](std::size_t c) { return of_[c] != kNone; });
  return cell ? of_[*cell] : kNone;
}

const Room* RoomGraph::find(const std::string& id) const {
  const auto place = std::find_if(rooms_.begin(), rooms_.end(), [&](const Room& room) { return room.id == id; });
  return place == rooms_.end() ? nullptr : &*place;
}

RoomGraph room_graph(const museum::Museum& museum, const RegionParams& params) {
  constexpr int kNone = RoomGraph::kNone;
  const TopologicalMap map = topological_map(floor_of(museum), params);
  const GridFrame& frame = map.regions.frame;
  const Division division = divide(map.regions, museum.rooms);
  const std::vector<Touch> touches = touches_of(frame, division.of);
  std::vector<std::set<int>> next(division.place_of.size());
  for (const Touch& touch : touches) {
    next[static_cast<std::size_t>(touch.first)].insert(touch.second);
    next[static_cast<std::size_t>(touch.second)].insert(touch.first);
  }
  std::vector<Point2> at;
  for (std::size_t i = 0; i < division.place_of.size(); ++i) {
    const bool is_floor = division.place_of[i] != kNone;
    at.push_back(i < museum.rooms.size() ? museum.rooms[i].at
                 : is_floor              ? map.places[static_cast<std::size_t>(division.place_of[i])].middle
                                         : Point2{});
  }

  RoomGraph graph;
  graph.frame_ = frame;
  graph.of_.assign(frame.size(), kNone);
  const auto home = nearest_cell(frame, museum.home.position(), [&](std::size_t c) { return division.of[c] != kNone; });
  if (!home) return graph;
  const std::vector<int> order = walk(division.of[*home], next, at);
  std::vector<int> new_number(division.place_of.size(), kNone);
  for (std::size_t i = 0; i < order.size(); ++i) new_number[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  const auto renumbered = [&](int room) { return room == kNone ? kNone : new_number[static_cast<std::size_t>(room)]; };
  Namer namer{museum};
  for (const int old : order) {
    const auto number = static_cast<std::size_t>(old);
    Room& room = graph.rooms_.emplace_back();
    room.kind = map.places[static_cast<std::size_t>(division.place_of[number])].kind;
    room.at = at[number];
    namer.name(room, number);
    for (const int other : next[number]) room.next.push_back(renumbered(other));
    std::sort(room.next.begin(), room.next.end());
  }
  for (std::size_t i = 0; i < frame.size(); ++i) graph.of_[i] = renumbered(division.of[i]);
  for (const Gap& gap : map.regions.gaps) {
    const Touch* nearest = nullptr;
    for (const Touch& touch : touches) {
      const std::array places{division.place_of[static_cast<std::size_t>(touch.first)],
                              division.place_of[static_cast<std::size_t>(touch.second)]};
      const bool is_there =
          (places[0] == gap.first && places[1] == gap.second) || (places[0] == gap.second && places[1] == gap.first);
      if (is_there && (nearest == nullptr || distance(touch.at, gap.at) < distance(nearest->at, gap.at)))
        nearest = &touch;
    }
    if (nearest == nullptr || renumbered(nearest->first) == kNone) continue;
    graph.doors_.push_back({gap.at, gap.width, renumbered(nearest->first), renumbered(nearest->second)});
  }
  return graph;
}

}  // namespace docent::mapping
