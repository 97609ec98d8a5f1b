#include "docent/museum/day_plan.h"

#include <cstdio>
#include <vector>

#include "docent/base/suggestion.h"

namespace docent::museum {
namespace {

constexpr int kDay = 24 * 60;  // [min]

}  // namespace

std::optional<NextMode> next_mode(const Museum& museum, int minute_of_day) {
  const std::string present = mode_at(museum, minute_of_day);
  std::optional<NextMode> next;
  int soonest = kDay;
  for (const auto& [name, mode] : museum.modes) {
    for (const std::string& text : mode.hours) {
      const auto hours = parse_hours(text);
      if (!hours) continue;
      for (const int minute : {hours->from_minute, hours->to_minute % kDay}) {
        const int until = (minute - minute_of_day + kDay) % kDay;
        if (until == 0 || until >= soonest) continue;
        std::string then = mode_at(museum, minute);
        if (then == present) continue;
        soonest = until;
        next = NextMode{std::move(then), minute};
      }
    }
  }
  return next;
}

std::optional<DailyTour> next_daily_tour(const Museum& museum, int minute_of_day, int within) {
  std::optional<DailyTour> next;
  int soonest = within + 1;
  for (const Tour& tour : museum.tours) {
    for (const int minute : tour.daily) {
      const int until = (minute - minute_of_day + kDay) % kDay;
      if (until >= soonest || mode_at(museum, minute) != "open") continue;
      soonest = until;
      next = DailyTour{tour.id, minute};
    }
  }
  return next;
}

std::string mode_meant(const std::string& word) {
  std::vector<std::string> names{kModes.begin(), kModes.end()};
  names.emplace_back("hours");
  return did_you_mean(word, names);
}

std::string clock_text(int minute_of_day) {
  char text[16];
  std::snprintf(text, sizeof text, "%02d:%02d", minute_of_day / 60, minute_of_day % 60);
  return text;
}

}  // namespace docent::museum
