#include "docent/apps/simulate/simulation_picture.h"

#include <cmath>
#include <string_view>

#include "docent/messages/conversions.h"
#include "docent/pictures/notes.h"

namespace docent::apps::simulate_command {
namespace {

constexpr pictures::Color kHazard{214, 90, 70, 90};
constexpr pictures::Color kArea = pictures::with_alpha(pictures::colors::kGreen, 170);
constexpr pictures::Color kTouch{220, 20, 20, 255};
constexpr pictures::Color kExhibit{150, 90, 30, 255};

// [points]
constexpr double kWay = 1.2;
constexpr double kOutline = 0.8;
constexpr double kDot = 4.0;
constexpr double kRing = 6.0;

}  // namespace

void SimulationPicture::add(const transport::TopicInfo& topic, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kTrueState.name) {
    const auto& state = *static_cast<const docent_msgs::TrueState*>(message.get());
    last_ = {to_seconds(from_message(state.header.stamp)), {state.x, state.y}};
    if (way_.empty() || distance(way_.back().place, last_.place) > 0.1) way_.push_back(last_);
  } else if (name == topics::kTrueContact.name) {
    const auto& contact = *static_cast<const docent_msgs::TrueContact*>(message.get());
    contacts_.push_back({contact.x, contact.y});
  }
}

Result<void> SimulationPicture::save(const museum::Museum& museum, const std::string& path) const {
  std::vector<pictures::TimedPoint> way = way_;
  if (!way.empty()) way.push_back(last_);
  const double begin = way.empty() ? 0.0 : way.front().time;
  pictures::Figure figure{museum.folder.filename().string() + ", " + std::to_string(std::lround(begin)) + " to " +
                          std::to_string(std::lround(last_.time)) + " s"};
  pictures::Axes& axes = figure.add(pictures::Axes::metres(museum.map.frame));
  pictures::draw_map(axes, museum.map);
  for (const auto& hazard : museum.hazards) pictures::draw_area(axes, hazard.polygon, kHazard);
  axes.add(
      [corners = axes.page(museum.area)](pictures::Canvas& canvas) { canvas.draw_polygon(corners, kOutline, kArea); });
  pictures::draw_timed_path(axes, way, kWay);
  if (!way.empty()) {
    const Point2 ends[] = {way.front().place, way.back().place};
    pictures::draw_points(axes, std::span{ends, 1}, kDot, pictures::colors::kBlue);
    pictures::draw_points(axes, std::span{ends}.subspan(1), kDot, pictures::colors::kRed);
  }
  std::vector<Point2> exhibits;
  for (const auto& exhibit : museum.exhibits) exhibits.push_back(exhibit.pose.position());
  pictures::draw_points(axes, exhibits, kDot, kExhibit);
  std::vector<pictures::Note> names;
  for (const auto& exhibit : museum.exhibits) names.push_back({exhibit.pose.position(), exhibit.id});
  pictures::draw_notes(axes, names);
  axes.add([places = axes.page(contacts_)](pictures::Canvas& canvas) {
    for (const Point2 place : places) canvas.draw_circle(place, 0.5 * kRing, 1.0, kTouch);
  });
  pictures::add_map_legend(figure);
  figure.add_legend(pictures::legend_line("true trajectory, coloured by time", kWay, pictures::rainbow(0.4)));
  figure.add_legend(pictures::legend_disc("start", kDot, pictures::colors::kBlue));
  figure.add_legend(pictures::legend_disc("end", kDot, pictures::colors::kRed));
  if (!exhibits.empty()) figure.add_legend(pictures::legend_disc("exhibit", kDot, kExhibit));
  if (!museum.hazards.empty()) figure.add_legend(pictures::legend_of_area("hazard", kHazard));
  if (!museum.area.empty()) figure.add_legend(pictures::legend_line("operating area", kOutline, kArea));
  if (!contacts_.empty()) figure.add_legend(pictures::legend_ring("contact, whoever caused it", kRing, 1.0, kTouch));
  return figure.save(path);
}

}  // namespace docent::apps::simulate_command
