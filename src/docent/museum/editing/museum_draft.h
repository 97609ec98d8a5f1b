#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/museum/museum.h"

namespace docent::museum {

/// In which hours which mode holds, by its name (kModes): as parse_hours reads them.
using ModeHours = std::map<std::string, std::vector<std::string>>;

/// What an editor may change of a museum, as people want it to be. Of exhibits, `next` is not looked at.
struct MuseumDraft {
  Polygon area;  ///< [m], map
  std::vector<Hazard> hazards;
  Pose2 home;
  std::optional<Pose2> charger;
  std::vector<Exhibit> exhibits;
  std::vector<Tour> tours;
  std::vector<Room> rooms;
  ModeHours hours;  ///< a mode that is not named has none
};

[[nodiscard]] MuseumDraft draft_of(const Museum& museum);

/// To the millimetre, and a tenth of a degree: so they are written.
[[nodiscard]] bool is_same(const Pose2& one, const Pose2& other);
[[nodiscard]] bool is_same(const Polygon& one, const Polygon& other);
[[nodiscard]] bool is_same(const Hazard& one, const Hazard& other);
[[nodiscard]] bool is_same(const std::vector<Pose2>& one, const std::vector<Pose2>& other);
/// Texts but for space at their ends.
[[nodiscard]] bool is_same(const Translations& one, const Translations& other);
[[nodiscard]] bool is_same(const std::vector<Link>& one, const std::vector<Link>& other);
[[nodiscard]] bool is_same(const Exhibit& one, const Exhibit& other);
[[nodiscard]] bool is_same(const Tour& one, const Tour& other);
[[nodiscard]] bool is_same(const Room& one, const Room& other);
[[nodiscard]] bool is_same(const ModeHours& one, const ModeHours& other);
/// In whatever order.
[[nodiscard]] bool is_same(const MuseumDraft& one, const MuseumDraft& other);

}  // namespace docent::museum
