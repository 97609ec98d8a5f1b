#include "docent/task_control/tour_scheduler/programme.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace docent::task_control {

const ProgrammeExhibit* Programme::find_exhibit(const std::string& id) const {
  const auto place = std::find_if(exhibits.begin(), exhibits.end(), [&](const auto& e) { return e.id == id; });
  return place == exhibits.end() ? nullptr : &*place;
}

const ProgrammeTour* Programme::find_tour(const std::string& id) const {
  const auto place = std::find_if(tours.begin(), tours.end(), [&](const auto& t) { return t.id == id; });
  return place == tours.end() ? nullptr : &*place;
}

const ProgrammeRoom* Rooms::find(const std::string& id) const {
  const auto place = std::find_if(rooms.begin(), rooms.end(), [&](const auto& room) { return room.id == id; });
  return place == rooms.end() ? nullptr : &*place;
}

const ProgrammeRoom* Rooms::after(Point2 point) const {
  const int here = room_at ? room_at(point) : -1;
  const int count = static_cast<int>(rooms.size());
  if (count == 0 || (count == 1 && here == 0)) return nullptr;
  return &rooms[static_cast<std::size_t>((here + 1) % count)];
}

SpokenLength ProgrammeExhibit::length_in(const std::string& language) const {
  const auto place = spoken.find(language);
  return place == spoken.end() ? SpokenLength{speech_s, long_s} : place->second;
}

std::string place_name(const WishedStop& stop) {
  return stop.viewpoint < 0 ? stop.exhibit_id : stop.exhibit_id + "/" + std::to_string(stop.viewpoint);
}

std::string place_at(const Programme& programme, Point2 position) {
  std::string name;
  double nearest = kAtPlace;
  const auto try_place = [&](const Pose2& pose, const std::string& of_place) {
    const double off = distance(position, pose.position());
    if (off >= nearest) return;
    nearest = off;
    name = of_place;
  };
  for (const ProgrammeExhibit& exhibit : programme.exhibits) {
    if (exhibit.is_point) continue;  // nobody learns ways to it
    for (int viewpoint = -1; viewpoint < static_cast<int>(exhibit.viewpoints.size()); ++viewpoint)
      try_place(exhibit.place(viewpoint), place_name({exhibit.id, viewpoint}));
  }
  try_place(programme.home, "home");
  if (programme.charger) try_place(*programme.charger, "charger");
  return name;
}

std::optional<PointWish> point_of(const std::string& target) {
  constexpr double kFarthest = 10'000.0;  // [m]
  constexpr double kLargest = 100.0;      // [rad]
  double x = 0.0;
  double y = 0.0;
  double heading = 0.0;
  int point = 0;
  int pose = 0;
  const int numbers = std::sscanf(target.c_str(), "%lf,%lf%n,%lf%n", &x, &y, &point, &heading, &pose);
  const auto used = static_cast<std::size_t>(numbers == 3 ? pose : point);
  if (numbers < 2 || used != target.size()) return std::nullopt;
  if (!(std::abs(x) < kFarthest && std::abs(y) < kFarthest)) return std::nullopt;
  if (numbers == 2) return PointWish{{x, y}};
  if (!(std::abs(heading) < kLargest)) return std::nullopt;
  return PointWish{{x, y}, Angle::radians(heading)};
}

std::string point_name(const PointWish& wish) {
  // Adding zero turns -0.00 into 0.00.
  const auto rounded = [](double value) { return std::round(100.0 * value) / 100.0 + 0.0; };
  char text[60];
  if (wish.heading) {
    std::snprintf(text, sizeof text, "%.2f,%.2f,%.2f", rounded(wish.place.x), rounded(wish.place.y),
                  rounded(wish.heading->radians()));
  } else {
    std::snprintf(text, sizeof text, "%.2f,%.2f", rounded(wish.place.x), rounded(wish.place.y));
  }
  return text;
}

bool is_same(const Pose2& a, const Pose2& b) {
  constexpr double kRounding = 1e-6;
  return distance(a.position(), b.position()) < kRounding && std::abs((a.theta - b.theta).radians()) < kRounding;
}

}  // namespace docent::task_control
