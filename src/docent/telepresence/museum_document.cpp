#include "docent/telepresence/museum_document.h"

#include <png.h>

#include <utility>
#include <vector>

#include "docent/museum/day_plan.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/documents.h"

namespace docent::telepresence {
std::string picture_address(const museum::Exhibit& exhibit) {
  if (exhibit.picture.empty()) return {};
  return "/api/pictures/" + exhibit.id + exhibit.picture.extension().string();
}

documents::Pose document_of(const Pose2& pose) { return {pose.x, pose.y, pose.theta.radians()}; }

std::vector<documents::Point> document_of(const Polygon& polygon) {
  std::vector<documents::Point> corners;
  for (const Point2 corner : polygon) corners.push_back({corner.x, corner.y});
  return corners;
}

documents::Hazard document_of(const museum::Hazard& hazard) {
  return {hazard.id, hazard.kind, document_of(hazard.polygon)};
}

documents::Exhibit document_of(const museum::Exhibit& exhibit) {
  documents::Exhibit document{exhibit.id,
                              exhibit.title,
                              document_of(exhibit.pose),
                              {exhibit.look_at.x, exhibit.look_at.y},
                              {},
                              exhibit.short_text,
                              exhibit.long_text,
                              exhibit.topics,
                              exhibit.web_only,
                              picture_address(exhibit),
                              {}};
  for (const auto& link : exhibit.links) document.links.push_back({link.title, link.url});
  for (const auto& viewpoint : exhibit.viewpoints) document.viewpoints.push_back(document_of(viewpoint));
  return document;
}

documents::Tour document_of(const museum::Tour& tour) {
  documents::Tour document{tour.id, tour.title, tour.exhibits, tour.minutes, {}};
  for (const int minute : tour.daily) document.daily.push_back(museum::clock_text(minute));
  return document;
}

std::string encode_museum(const museum::Museum& museum, double robot_radius, documents::Rooms rooms) {
  const GridFrame& frame = museum.map.frame;
  documents::Museum document;
  document.name = museum.name;
  document.languages = museum.languages;
  document.area = document_of(museum.area);
  document.home = document_of(museum.home);
  if (museum.charger) document.charger = document_of(*museum.charger);
  document.robot_radius = robot_radius;
  document.map = {"/api/map.png", frame.columns, frame.rows, frame.resolution, {frame.origin.x, frame.origin.y}};
  for (const auto& hazard : museum.hazards) document.hazards.push_back(document_of(hazard));
  for (const auto& exhibit : museum.exhibits) document.exhibits.push_back(document_of(exhibit));
  for (const auto& tour : museum.tours) document.tours.push_back(document_of(tour));
  document.rooms = std::move(rooms.rooms);
  document.doors = std::move(rooms.doors);
  return json_text(document);
}

Reason why_not_in(const museum::Museum& museum, const RequestMessage& message) {
  if (is_place(message.kind)) return {};  // the mission knows where the robot can go
  if (message.kind == RequestKind::tour) {
    if (museum.find_tour(message.target) == nullptr) return {ReasonWord::no_such_tour, message.target};
    return {};
  }
  const museum::Exhibit* exhibit = museum.find_exhibit(message.target);
  if (exhibit == nullptr) return {ReasonWord::no_such_exhibit, message.target};
  if (message.viewpoint >= static_cast<int>(exhibit->viewpoints.size())) return ReasonWord::no_such_viewpoint;
  return {};
}

Result<std::string> encode_map_png(const OccupancyGrid& map) {
  const auto columns = static_cast<std::size_t>(map.frame.columns);
  const auto rows = static_cast<std::size_t>(map.frame.rows);
  std::vector<png_byte> pixels(columns * rows);
  for (int row = 0; row < map.frame.rows; ++row) {
    const std::size_t line = (rows - 1 - static_cast<std::size_t>(row)) * columns;
    for (int column = 0; column < map.frame.columns; ++column) {
      const CellIndex cell{column, row};
      const png_byte grey = map.is_occupied(cell) ? 0 : map.is_free(cell) ? 255 : 128;
      pixels[line + static_cast<std::size_t>(column)] = grey;
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(columns);
  image.height = static_cast<png_uint_32>(rows);
  image.format = PNG_FORMAT_GRAY;
  png_alloc_size_t size = 0;
  if (png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr) == 0) {
    return fail(std::string{"the map cannot be made a picture: "} + image.message);
  }
  std::string png(size, '\0');
  if (png_image_write_to_memory(&image, png.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    return fail(std::string{"the map cannot be made a picture: "} + image.message);
  }
  png.resize(size);
  return png;
}

}  // namespace docent::telepresence
