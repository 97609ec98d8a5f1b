#pragma once

#include <string>
#include <vector>

#include "docent/mapping/rooms/room_graph.h"

namespace docent::modules {

/// What a room is called in each of the museum's languages: the name that the museum gives it, else its kind and
/// number.
[[nodiscard]] museum::Translations name_of(const mapping::Room& room, const std::vector<std::string>& languages);

}  // namespace docent::modules
