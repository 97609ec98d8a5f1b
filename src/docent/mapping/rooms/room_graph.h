#pragma once

#include <string>
#include <vector>

#include "docent/mapping/topological/topological_map.h"
#include "docent/museum/museum.h"

namespace docent::mapping {

/// A room, a hallway, or a part of one that the museum gives a name of its own.
struct Room {
  std::string id;  ///< the museum's, or KIND-NUMBER where it names none
  PlaceKind kind = PlaceKind::room;
  museum::Translations name;  ///< empty: the museum names none
  int number = 0;             ///< from 1, of its kind, among those without a name; 0: it has one
  Point2 at;                  ///< [m], map: where the robot goes in it
  std::vector<int> next;      ///< rooms that one walks into from here, ascending
};

struct Door {
  Point2 at;           ///< [m], map: its middle
  double width = 0.0;  ///< [m]
  int first = 0, second = 0;
};

/// The rooms of a museum, in the order of a walk from home through all of them: from each to the nearest one beside it
/// that is still to come, and back where none is.
class RoomGraph {
 public:
  static constexpr int kNone = -1;

  [[nodiscard]] const std::vector<Room>& rooms() const { return rooms_; }
  [[nodiscard]] const std::vector<Door>& doors() const { return doors_; }
  /// The room of a point on the floor, or of the floor near it; kNone: the robot gets nowhere near. O(1) on the floor.
  [[nodiscard]] int room_at(Point2 point) const;
  /// nullptr: there is no such room.
  [[nodiscard]] const Room* find(const std::string& id) const;

 private:
  friend RoomGraph room_graph(const museum::Museum& museum, const RegionParams& params);
  std::vector<Room> rooms_;
  std::vector<Door> doors_;
  GridFrame frame_;
  std::vector<int> of_;  ///< [cells] room, kNone: none
};

/// From the museum's map within its area and outside of its hazards, and from the names that it gives. Rooms to which
/// no way leads from home are left out. As long as `topological_map` takes, and O(cells log cells).
[[nodiscard]] RoomGraph room_graph(const museum::Museum& museum, const RegionParams& params = {});

}  // namespace docent::mapping
