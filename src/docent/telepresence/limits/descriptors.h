#pragma once

#include <cstddef>

namespace docent::telepresence {

/// Has this process open so many files and sockets, as far as the system lets it: most begin with 1,024, which as many
/// strangers fill. @returns how many it may open now
std::size_t allow_descriptors(std::size_t wanted);

}  // namespace docent::telepresence
