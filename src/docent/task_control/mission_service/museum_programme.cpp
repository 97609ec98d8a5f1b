#include "docent/task_control/mission_service/museum_programme.h"

#include <utility>

#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/task_control/travel_times/travel.h"

namespace docent::task_control {
namespace {

/// As the executive speaks it.
SpokenLength length_of(const museum::Exhibit& exhibit, const std::string& language) {
  const auto seconds_of = [&](const std::string& text) {
    return interaction::speech_duration(text, language, Mood::neutral);
  };
  const auto spoken = [&](const museum::Translations& text) {
    return interaction::spoken_text(museum::translated(text, language));
  };
  return {seconds_of(spoken(exhibit.title) + " " + spoken(exhibit.short_text)), seconds_of(spoken(exhibit.long_text))};
}

}  // namespace

Programme programme_of(const museum::Museum& museum) {
  Programme programme;
  if (!museum.languages.empty()) programme.languages = museum.languages;
  programme.home = museum.home;
  programme.charger = museum.charger;
  const std::string& language = programme.languages.front();
  const std::string farewell = interaction::sentence(interaction::Sentence::farewell, language, Mood::happy, 0);
  programme.farewell_s = interaction::speech_duration(farewell, language, Mood::happy);
  for (const museum::Exhibit& exhibit : museum.exhibits) {
    ProgrammeExhibit& shown = programme.exhibits.emplace_back();
    const SpokenLength own = length_of(exhibit, language);
    shown = {exhibit.id, exhibit.pose, exhibit.viewpoints, own.short_s, exhibit.web_only};
    shown.long_s = own.long_s;
    for (const std::string& other : programme.languages) shown.spoken[other] = length_of(exhibit, other);
    for (const museum::Exhibit* next : museum::sensible_next(museum, exhibit)) shown.next.push_back(next->id);
  }
  for (const museum::Tour& tour : museum.tours)
    programme.tours.push_back({tour.id, tour.exhibits, 60.0 * tour.minutes.value_or(0.0)});
  return programme;
}

std::shared_ptr<const planning::RoutePlanner> ways_in(const museum::Museum& museum, double robot_radius) {
  if (museum.map.cells.empty()) return nullptr;
  planning::RouteParams params;
  params.robot_radius = robot_radius;
  return std::make_shared<planning::RoutePlanner>(museum.map, museum.hazard_polygons(), museum.area, params);
}

Programme programme_on_map(const museum::Museum& museum, std::shared_ptr<const planning::RoutePlanner> ways,
                           std::function<const Rooms&()> rooms) {
  Programme programme = programme_of(museum);
  if (!ways) return programme;
  programme.has_room = [ways = std::move(ways)](Point2 place) { return !ways->is_closed(place); };
  programme.rooms = std::move(rooms);
  return programme;
}

TravelDistance travel_by(const std::shared_ptr<const planning::RoutePlanner>& ways) {
  return ways ? travel_on_map(*ways) : straight_distance();
}

}  // namespace docent::task_control
