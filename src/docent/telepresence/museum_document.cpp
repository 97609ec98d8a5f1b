#include "docent/telepresence/museum_document.h"

#include <png.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace docent {
namespace {

using Json = nlohmann::json;

Json translations_of(const Translations& texts) {
  Json json = Json::object();
  for (const auto& [language, text] : texts) json[language] = text;
  return json;
}

Json pose_of(const Pose2& pose) { return {pose.x, pose.y, pose.theta.radians()}; }

Json polygon_of(const Polygon& polygon) {
  Json json = Json::array();
  for (const Point2 corner : polygon) json.push_back({corner.x, corner.y});
  return json;
}

const char* name_of(HazardKind kind) {
  switch (kind) {
    case HazardKind::glass:
      return "glass";
    case HazardKind::plate:
      return "plate";
    case HazardKind::stairs:
      return "stairs";
    case HazardKind::other:
      break;
  }
  return "other";
}

}  // namespace

std::string encode_museum(const Museum& museum, double robot_radius) {
  Json json{{"name", translations_of(museum.name)},
            {"languages", museum.languages},
            {"area", polygon_of(museum.area)},
            {"home", pose_of(museum.home)},
            {"charger", museum.charger ? pose_of(*museum.charger) : Json{}},
            {"robot_radius", robot_radius},
            {"map",
             {{"url", "/api/map.png"},
              {"columns", museum.map.frame.columns},
              {"rows", museum.map.frame.rows},
              {"resolution", museum.map.frame.resolution},
              {"origin", {museum.map.frame.origin.x, museum.map.frame.origin.y}}}}};
  Json& hazards = json["hazards"] = Json::array();
  for (const auto& hazard : museum.hazards) {
    hazards.push_back({{"id", hazard.id}, {"kind", name_of(hazard.kind)}, {"polygon", polygon_of(hazard.polygon)}});
  }
  Json& exhibits = json["exhibits"] = Json::array();
  for (const auto& exhibit : museum.exhibits) {
    Json viewpoints = Json::array();
    for (const auto& viewpoint : exhibit.viewpoints) viewpoints.push_back(pose_of(viewpoint));
    exhibits.push_back({{"id", exhibit.id},
                        {"title", translations_of(exhibit.title)},
                        {"pose", pose_of(exhibit.pose)},
                        {"look_at", {exhibit.look_at.x, exhibit.look_at.y}},
                        {"viewpoints", std::move(viewpoints)},
                        {"short", translations_of(exhibit.short_text)},
                        {"long", translations_of(exhibit.long_text)},
                        {"topics", exhibit.topics},
                        {"web_only", exhibit.web_only}});
  }
  Json& tours = json["tours"] = Json::array();
  for (const auto& tour : museum.tours) {
    tours.push_back({{"id", tour.id},
                     {"title", translations_of(tour.title)},
                     {"exhibits", tour.exhibits},
                     {"minutes", tour.minutes ? Json(*tour.minutes) : Json{}}});
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
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

}  // namespace docent
