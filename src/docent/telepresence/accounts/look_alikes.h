#pragma once

#include <string_view>

namespace docent::telepresence {

/// Whether a reader may take one name for the other: case, spaces, signs and what cannot be seen do not count, and
/// characters of Unicode that look alike are the same (Unicode Technical Standard 39, skeletons). O(length)
[[nodiscard]] bool looks_like(std::string_view name, std::string_view other);

}  // namespace docent::telepresence
