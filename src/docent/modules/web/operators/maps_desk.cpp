#include "docent/modules/web/operators/maps_desk.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/documents.h"

namespace docent::modules {
namespace {

constexpr Duration kShowPeriod = std::chrono::seconds{1};

/// A byte a cell, as `level` makes it of what the grid says.
template <class Level>
telepresence::documents::Raster raster_of(const nav_msgs::OccupancyGrid& grid, Level level) {
  if (grid.data.size() != std::size_t{grid.info.width} * grid.info.height) return {};
  std::vector<std::uint8_t> levels;
  levels.reserve(grid.data.size());
  std::transform(grid.data.begin(), grid.data.end(), std::back_inserter(levels), level);
  const auto& origin = grid.info.origin.position;
  return {origin.x,
          origin.y,
          static_cast<double>(grid.info.resolution),
          static_cast<int>(grid.info.width),
          static_cast<int>(grid.info.height),
          telepresence::base64(levels)};
}

std::uint8_t level_of_value(std::int8_t share) {
  return share < 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(255 - 254 * std::min<int>(share, 100) / 100);
}
std::uint8_t level_of_thing(std::int8_t occupied) { return occupied >= 50 ? std::uint8_t{255} : std::uint8_t{0}; }

}  // namespace

void MapsDesk::begin(telepresence::WebServer& server, int slot) {
  server.restrict_to(telepresence::Stream::operators, slot);
  bus_.subscribe<nav_msgs::OccupancyGrid>(topics::kValueFunction, [this](const auto& grid) { value_ = grid; });
  bus_.subscribe<nav_msgs::OccupancyGrid>(topics::kLiveMap, [this](const auto& map) { take(map); });
  bus_.subscribe<docent_msgs::LiveMapUpdate>(topics::kLiveMapUpdate, [this](const auto& update) { take(update); });
  bus_.every(kShowPeriod, [this, &server, slot] {
    std::string text = document();
    if (std::exchange(shown_, text) != text) server.broadcast(slot, std::move(text));
  });
}

std::string MapsDesk::document() const {
  return telepresence::json_text(
      telepresence::documents::MapsMessage{raster_of(value_, level_of_value), raster_of(live_, level_of_thing)});
}

void MapsDesk::take(const nav_msgs::OccupancyGrid& map) {
  live_ = map;
  number_ = 0;
}

void MapsDesk::take(const docent_msgs::LiveMapUpdate& update) {
  // After a gap the next full map comes within ten seconds.
  if (from_message(update.base) != from_message(live_.header.stamp) || update.number != number_ + 1) return;
  if (update.data.size() != std::size_t{update.width} * update.height) return;
  number_ = update.number;
  for (std::uint32_t row = 0; row < update.height; ++row) {
    for (std::uint32_t column = 0; column < update.width; ++column) {
      const std::int64_t x = std::int64_t{update.x} + column;
      const std::int64_t y = std::int64_t{update.y} + row;
      if (x < 0 || y < 0 || x >= live_.info.width || y >= live_.info.height) continue;
      const std::size_t cell = static_cast<std::size_t>(y) * live_.info.width + static_cast<std::size_t>(x);
      if (cell < live_.data.size()) live_.data[cell] = update.data[std::size_t{row} * update.width + column];
    }
  }
}

}  // namespace docent::modules
