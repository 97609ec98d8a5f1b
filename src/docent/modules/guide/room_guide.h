#pragma once

#include <optional>
#include <string>

#include "docent/mapping/rooms/room_graph.h"
#include "docent/modules/shared/room_names.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::modules {

/// The museum's rooms, made when somebody asks for them first.
class RoomGuide {
 public:
  explicit RoomGuide(const museum::Museum& museum) : museum_{museum} {}
  [[nodiscard]] const mapping::RoomGraph& graph() {
    if (!graph_) graph_ = mapping::room_graph(museum_);
    return *graph_;
  }
  [[nodiscard]] const task_control::Rooms& rooms() {
    if (rooms_.room_at) return rooms_;
    for (const mapping::Room& room : graph().rooms()) rooms_.rooms.push_back({room.id, room.at});
    rooms_.room_at = [this](Point2 point) { return graph().room_at(point); };
    return rooms_;
  }
  /// By its id; empty: there is no such room.
  [[nodiscard]] museum::Translations name(const std::string& id) {
    const mapping::Room* room = graph().find(id);
    return room != nullptr ? name_of(*room, museum_.languages) : museum::Translations{};
  }

 private:
  const museum::Museum& museum_;
  std::optional<mapping::RoomGraph> graph_;
  task_control::Rooms rooms_;
};

}  // namespace docent::modules
