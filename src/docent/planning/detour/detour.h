#pragma once

#include <string>

namespace docent::planning {

/// How the way differs from the one that was meant before something stood in it: not, by a loop that comes back to it
/// soon, or altogether ([Rhino1999] 5.3). The planner sees it, the reaction ladder tells of it.
enum class Detour { none, local, global };
[[nodiscard]] const char* to_text(Detour detour);
[[nodiscard]] Detour detour_of(const std::string& text);  ///< none for an unknown text

}  // namespace docent::planning
