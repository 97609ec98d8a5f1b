#include "docent/planning/detour/detour.h"

#include <array>

namespace docent::planning {

const char* to_text(Detour detour) {
  constexpr std::array<const char*, 3> kTexts{"none", "local", "global"};
  return kTexts[static_cast<std::size_t>(detour)];
}

Detour detour_of(const std::string& text) {
  if (text == to_text(Detour::local)) return Detour::local;
  return text == to_text(Detour::global) ? Detour::global : Detour::none;
}

}  // namespace docent::planning
