#include "docent/task_control/mission_service/daily_tours.h"

#include <utility>

namespace docent::task_control {
namespace {

constexpr int kDay = 24 * 60;  // [min]

std::string wish_id(const museum::DailyTour& tour, std::int64_t day) {
  return "daily-" + tour.tour + "-" + museum::clock_text(tour.minute_of_day) + "-" + std::to_string(day);
}

}  // namespace

std::optional<museum::DailyTour> DailyTours::due(int minute_of_day) const {
  for (int late = 0; late <= kLate; ++late)
    if (auto tour = museum::next_daily_tour(museum_, (minute_of_day - late + kDay) % kDay, 0)) return tour;
  return std::nullopt;
}

std::string DailyTours::language_due(const museum::DailyTour& tour, int minute_of_day, std::int64_t day) {
  const std::string id = wish_id(tour, day);
  if (spoken_of_ != id) {
    spoken_of_ = id;
    languages_ = 0;
    spoken_at_ = -1;
  }
  const int left = (tour.minute_of_day - minute_of_day + kDay) % kDay;
  if (left == 0 || left > kSpoken || minute_of_day == spoken_at_ || languages_ >= museum_.languages.size()) return {};
  spoken_at_ = minute_of_day;
  return museum_.languages[languages_++];
}

DailyTours::News DailyTours::look(int minute_of_day, std::int64_t day, bool is_open, bool may_speak, Time now) {
  News news;
  if (!is_open) return news;
  if (const auto tour = due(minute_of_day)) {
    std::string id = wish_id(*tour, day);
    if (id != begun_) {
      begun_ = id;
      news.begins =
          VisitorRequest{std::move(id), now, RequestSource::staff, "timetable", RequestKind::tour, tour->tour, -1, ""};
    }
  }
  news.soon = museum::next_daily_tour(museum_, (minute_of_day + 1) % kDay, kShown - 1);
  if (news.soon && may_speak) news.language = language_due(*news.soon, minute_of_day, day);
  return news;
}

std::string name_and_time(const museum::Museum& museum, const museum::DailyTour& tour, const std::string& language) {
  const museum::Tour* of_museum = museum.find_tour(tour.tour);
  const std::string name = of_museum == nullptr ? tour.tour : museum::translated(of_museum->title, language);
  return name + ", " + museum::clock_text(tour.minute_of_day);
}

}  // namespace docent::task_control
