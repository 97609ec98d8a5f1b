#include "docent/museum/museum.h"

#include <algorithm>
#include <cctype>

#include "docent/base/files.h"
#include "docent/museum/museum_file.h"
#include "docent/museum/museum_loading.h"
#include "docent/museum/museum_reader.h"

namespace docent::museum {

std::string translated(const Translations& texts, const std::string& language) {
  if (const auto found = texts.find(language); found != texts.end()) return found->second;
  return texts.empty() ? std::string{} : texts.begin()->second;
}

bool Hours::holds(int minute_of_day) const {
  if (from_minute < to_minute) return minute_of_day >= from_minute && minute_of_day < to_minute;
  return minute_of_day >= from_minute || minute_of_day < to_minute;
}

namespace {

/// Two digits; 1000: there are none.
int two_digits(const std::string& text, std::size_t at) {
  const auto is_digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(text[i])) != 0; };
  return is_digit(at) && is_digit(at + 1) ? (text[at] - '0') * 10 + (text[at + 1] - '0') : 1000;
}

}  // namespace

Result<Hours> parse_hours(const std::string& text) {
  const auto bad = [&] { return fail("hours '" + text + "': expected HH:MM-HH:MM"); };
  if (text.size() != 11 || text[2] != ':' || text[5] != '-' || text[8] != ':') return bad();
  const int from_hour = two_digits(text, 0);
  const int from_minute = two_digits(text, 3);
  const int to_hour = two_digits(text, 6);
  const int to_minute = two_digits(text, 9);
  if (from_hour > 23 || from_minute > 59 || to_hour > 24 || to_minute > 59) return bad();
  const Hours hours{from_hour * 60 + from_minute, to_hour * 60 + to_minute};
  if (hours.to_minute > 24 * 60 || hours.to_minute == 0) return bad();
  if (hours.from_minute == hours.to_minute) return fail("hours '" + text + "': begin and end are the same");
  return hours;
}

Result<int> parse_clock(const std::string& text) {
  const bool has_form = text.size() == 5 && text[2] == ':';
  const int hour = has_form ? two_digits(text, 0) : 1000;
  const int minute = has_form ? two_digits(text, 3) : 1000;
  if (hour > 23 || minute > 59) return fail("time '" + text + "': expected HH:MM");
  return hour * 60 + minute;
}

namespace {

bool any_holds(const std::vector<std::string>& all, int minute_of_day) {
  return std::any_of(all.begin(), all.end(), [&](const std::string& text) {
    const auto hours = parse_hours(text);
    return hours && hours->holds(minute_of_day);
  });
}

}  // namespace

std::string mode_at(const Museum& museum, int minute_of_day) {
  const auto has_hours = [&](const char* name) {
    const auto mode = museum.modes.find(name);
    return mode != museum.modes.end() && !mode->second.hours.empty();
  };
  const auto holds = [&](const char* name) {
    return has_hours(name) && any_holds(museum.modes.at(name).hours, minute_of_day);
  };
  if (holds("web")) return "web";
  if (holds("closed")) return "closed";
  return !has_hours("open") || holds("open") ? "open" : "closed";
}

double volume_at(const Museum& museum, int minute_of_day) {
  return any_holds(museum.sound.quiet_hours, minute_of_day) ? museum.sound.quiet_volume : 1.0;
}

const Exhibit* Museum::find_exhibit(const std::string& id) const {
  const auto found = std::find_if(exhibits.begin(), exhibits.end(), [&](const Exhibit& e) { return e.id == id; });
  return found == exhibits.end() ? nullptr : &*found;
}

std::vector<Polygon> Museum::hazard_polygons() const {
  std::vector<Polygon> polygons;
  for (const Hazard& hazard : hazards) polygons.push_back(hazard.polygon);
  return polygons;
}

const Tour* Museum::find_tour(const std::string& id) const {
  const auto found = std::find_if(tours.begin(), tours.end(), [&](const Tour& t) { return t.id == id; });
  return found == tours.end() ? nullptr : &*found;
}

std::vector<const Exhibit*> sensible_next(const Museum& museum, const Exhibit& exhibit) {
  const auto holds = [](const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  std::vector<const Exhibit*> result;
  for (const Exhibit& candidate : museum.exhibits) {
    if (candidate.id == exhibit.id || candidate.web_only) continue;
    const bool fits = exhibit.next.empty()
                          ? std::any_of(exhibit.topics.begin(), exhibit.topics.end(),
                                        [&](const std::string& topic) { return holds(candidate.topics, topic); })
                          : holds(exhibit.next, candidate.id);
    if (fits) result.push_back(&candidate);
  }
  return result;
}

std::size_t sensible_pairs(const Museum& museum) {
  std::size_t count = 0;
  for (const Exhibit& exhibit : museum.exhibits) {
    if (!exhibit.web_only) count += sensible_next(museum, exhibit).size();
  }
  return count;
}

Result<Museum> load_museum(const std::filesystem::path& folder, Stage stage) { return load_museum(folder, stage, {}); }

Result<Museum> load_museum(const std::filesystem::path& folder, Stage stage, const ReadingProgress& progress) {
  auto file = load_museum_file(folder);
  if (!file) return tl::unexpected<Error>(file.error());
  auto source = read_museum_file(*file, folder, stage);
  if (!source.faults.empty()) return tl::unexpected<Error>(source.faults.front());
  Museum museum = std::move(source.museum);
  museum.folder = folder;
  museum.map_path = folder / museum.map_path;
  if (museum.simulation_path) museum.simulation_path = folder / *museum.simulation_path;
  if (museum.sound.music) museum.sound.music = folder / *museum.sound.music;
  std::error_code code;
  if (!std::filesystem::is_regular_file(museum.map_path, code))
    return tl::unexpected<Error>(file->fault(file->root()["map"], museum.map_path.string() + " does not exist"));
  auto map = read_map(museum.map_path, progress);
  if (!map) return tl::unexpected<Error>(map.error());
  museum.map = std::move(map->map);
  museum.map_notes = std::move(map->notes);
  return museum;
}

}  // namespace docent::museum
