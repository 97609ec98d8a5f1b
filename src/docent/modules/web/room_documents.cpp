#include "docent/modules/web/room_documents.h"

#include "docent/mapping/rooms/room_graph.h"
#include "docent/modules/shared/room_names.h"

namespace docent::modules {

telepresence::documents::Rooms rooms_of(const museum::Museum& museum) {
  telepresence::documents::Rooms documents;
  if (museum.map.cells.empty()) return documents;
  const mapping::RoomGraph graph = mapping::room_graph(museum);
  const auto id_of = [&](int room) { return graph.rooms()[static_cast<std::size_t>(room)].id; };
  for (const mapping::Room& room : graph.rooms()) {
    auto& document = documents.rooms.emplace_back();
    document.id = room.id;
    document.name = name_of(room, museum.languages);
    document.at = {room.at.x, room.at.y};
    for (const int other : room.next) document.next.push_back(id_of(other));
  }
  for (const mapping::Door& door : graph.doors())
    documents.doors.push_back({{door.at.x, door.at.y}, door.width, {id_of(door.first), id_of(door.second)}});
  return documents;
}

}  // namespace docent::modules
