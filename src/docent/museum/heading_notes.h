#pragma once

#include <string>
#include <vector>

#include "docent/museum/museum.h"

namespace docent::museum {

/// Headings of museum.yaml that are allowed and yet likely a slip: they look like radians. For a person, with the name
/// of the place.
[[nodiscard]] std::vector<std::string> heading_notes(const Museum& museum);

}  // namespace docent::museum
