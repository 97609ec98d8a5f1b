#include "docent/museum/editing/museum_draft.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace docent::museum {
namespace {

constexpr double kMillimetre = 0.00051;                      // [m] half of what is written, and rounding
constexpr double kTenth = 0.051 * 3.14159265358979 / 180.0;  // [rad] likewise

bool is_near(double one, double other) { return std::abs(one - other) <= kMillimetre; }

std::string_view trimmed(std::string_view text) {
  constexpr const char* kSpace = " \t\r\n";
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Each of `one` has its equal, by id, in `other`, which has no more.
template <class T>
bool is_same_by_id(const std::vector<T>& one, const std::vector<T>& other) {
  return one.size() == other.size() && std::all_of(one.begin(), one.end(), [&](const T& item) {
           return std::any_of(other.begin(), other.end(),
                              [&](const T& candidate) { return candidate.id == item.id && is_same(item, candidate); });
         });
}

}  // namespace

MuseumDraft draft_of(const Museum& museum) {
  MuseumDraft draft{museum.area,     museum.hazards, museum.home,  museum.charger,
                    museum.exhibits, museum.tours,   museum.rooms, {}};
  for (const auto& [name, mode] : museum.modes) draft.hours[name] = mode.hours;
  return draft;
}

bool is_same(const Pose2& one, const Pose2& other) {
  return is_near(one.x, other.x) && is_near(one.y, other.y) && std::abs((one.theta - other.theta).radians()) <= kTenth;
}

bool is_same(const Polygon& one, const Polygon& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](Point2 a, Point2 b) { return is_near(a.x, b.x) && is_near(a.y, b.y); });
}

bool is_same(const Hazard& one, const Hazard& other) {
  return one.id == other.id && one.kind == other.kind && is_same(one.polygon, other.polygon);
}

bool is_same(const std::vector<Pose2>& one, const std::vector<Pose2>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const Pose2& a, const Pose2& b) { return is_same(a, b); });
}

bool is_same(const Translations& one, const Translations& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](const auto& a, const auto& b) {
    return a.first == b.first && trimmed(a.second) == trimmed(b.second);
  });
}

bool is_same(const std::vector<Link>& one, const std::vector<Link>& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const Link& a, const Link& b) { return is_same(a.title, b.title) && a.url == b.url; });
}

bool is_same(const Tour& one, const Tour& other) {
  return one.id == other.id && is_same(one.title, other.title) && one.exhibits == other.exhibits &&
         one.minutes == other.minutes && one.daily == other.daily;
}

bool is_same(const Room& one, const Room& other) {
  return one.id == other.id && is_same(one.name, other.name) && is_near(one.at.x, other.at.x) &&
         is_near(one.at.y, other.at.y);
}

bool is_same(const ModeHours& one, const ModeHours& other) {
  return std::all_of(kModes.begin(), kModes.end(), [&](const char* mode) {
    const auto hours_of = [mode](const ModeHours& all) {
      const auto place = all.find(mode);
      return place == all.end() ? std::vector<std::string>{} : place->second;
    };
    return hours_of(one) == hours_of(other);
  });
}

bool is_same(const Exhibit& one, const Exhibit& other) {
  return one.id == other.id && is_same(one.title, other.title) && is_same(one.pose, other.pose) &&
         is_near(one.look_at.x, other.look_at.x) && is_near(one.look_at.y, other.look_at.y) &&
         is_same(one.viewpoints, other.viewpoints) && is_same(one.short_text, other.short_text) &&
         is_same(one.long_text, other.long_text) && one.topics == other.topics && one.web_only == other.web_only &&
         one.picture == other.picture && is_same(one.links, other.links);
}

bool is_same(const MuseumDraft& one, const MuseumDraft& other) {
  if (one.charger.has_value() != other.charger.has_value()) return false;
  return is_same(one.area, other.area) && is_same_by_id(one.hazards, other.hazards) && is_same(one.home, other.home) &&
         (!one.charger || is_same(*one.charger, *other.charger)) && is_same_by_id(one.exhibits, other.exhibits) &&
         is_same_by_id(one.tours, other.tours) && is_same_by_id(one.rooms, other.rooms) &&
         is_same(one.hours, other.hours);
}

}  // namespace docent::museum
