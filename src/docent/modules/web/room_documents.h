#pragma once

#include "docent/museum/museum.h"
#include "docent/telepresence/documents.h"

namespace docent::modules {

/// The rooms and doors of the museum's map, for the page. As long as `room_graph` takes.
[[nodiscard]] telepresence::documents::Rooms rooms_of(const museum::Museum& museum);

}  // namespace docent::modules
