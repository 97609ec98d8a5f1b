#include "docent/apps/simulation_picture.h"

#include <string_view>

#include "docent/pictures/colors.h"
#include "docent/pictures/drawing.h"
#include "docent/pictures/map_picture.h"
#include "docent/pictures/text.h"

namespace docent {
namespace {

constexpr Color kHazard{214, 90, 70, 90};
constexpr Color kArea{70, 150, 90, 30};
constexpr Color kWay{40, 90, 200, 150};
constexpr Color kTouch{220, 20, 20, 255};
constexpr Color kExhibit{150, 90, 30, 255};
constexpr Color kInk{30, 30, 30, 255};

}  // namespace

void SimulationPicture::add(const TopicInfo& topic, const std::shared_ptr<const void>& message) {
  const std::string_view name = topic.name;
  if (name == topics::kTrueState.name) {
    const auto& state = *static_cast<const docent_msgs::TrueState*>(message.get());
    if (way_.empty() || distance(way_.back(), {state.x, state.y}) > 0.1) way_.push_back({state.x, state.y});
  } else if (name == topics::kTrueContact.name) {
    const auto& contact = *static_cast<const docent_msgs::TrueContact*>(message.get());
    contacts_.push_back({contact.x, contact.y});
  }
}

Result<void> SimulationPicture::save(const Museum& museum, const std::string& png) const {
  const MapView view = MapView::whole(museum.map.frame, 1400);
  Image image = draw_map(museum.map, view);
  for (const auto& hazard : museum.hazards) fill_polygon(image, view.pixels(hazard.polygon), kHazard);
  draw_area(image, view, museum.area, kArea);
  draw_path(image, view, way_, 2.0, kWay);
  for (const auto& exhibit : museum.exhibits) {
    fill_disc(image, view.pixel(exhibit.pose.position()), 4.0, kExhibit);
    draw_text(image, view.pixel(exhibit.pose.position()) + Point2{6, -6}, exhibit.id, kInk);
  }
  for (const auto& contact : contacts_) draw_circle(image, view.pixel(contact), 6.0, 2.0, kTouch);
  return save_png(image, png);
}

}  // namespace docent
