#pragma once

#include <optional>
#include <vector>

#include "docent/museum/museum.h"

namespace docent::museum {

/// What an editor may change of a museum, as people want it to be. Of exhibits, `picture` and `next` are not looked at.
struct MuseumDraft {
  Polygon area;  ///< [m], map
  std::vector<Hazard> hazards;
  Pose2 home;
  std::optional<Pose2> charger;
  std::vector<Exhibit> exhibits;
  std::vector<Tour> tours;
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
/// In whatever order.
[[nodiscard]] bool is_same(const MuseumDraft& one, const MuseumDraft& other);

}  // namespace docent::museum
