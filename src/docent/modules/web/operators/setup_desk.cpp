#include "docent/modules/web/operators/setup_desk.h"

#include <algorithm>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/grid_message.h"
#include "docent/telepresence/document_json.h"
#include "docent/telepresence/documents.h"
#include "docent/telepresence/museum_document.h"

namespace docent::modules {
namespace {

constexpr Duration kExplorationPeriod = std::chrono::milliseconds{500};
// Whoever asked for it hears that it is done before this module, too, begins anew.
constexpr Duration kReplyGoesOut = std::chrono::milliseconds{300};

/// What is known of a map, with some room: the map of a drive reaches as far as its beams do.
OccupancyGrid cropped(const OccupancyGrid& map) {
  constexpr int kRoom = 20;  // cells
  const GridFrame& frame = map.frame;
  CellIndex least{frame.columns, frame.rows};
  CellIndex most{-1, -1};
  for (int row = 0; row < frame.rows; ++row) {
    for (int column = 0; column < frame.columns; ++column) {
      if (map.at({column, row}) == OccupancyGrid::kUnknown) continue;
      least = {std::min(least.column, column), std::min(least.row, row)};
      most = {std::max(most.column, column), std::max(most.row, row)};
    }
  }
  if (most.column < 0) return map;
  least = {std::max(0, least.column - kRoom), std::max(0, least.row - kRoom)};
  most = {std::min(frame.columns - 1, most.column + kRoom), std::min(frame.rows - 1, most.row + kRoom)};
  OccupancyGrid part;
  part.frame = {most.column - least.column + 1,
                most.row - least.row + 1,
                frame.resolution,
                {frame.origin.x + least.column * frame.resolution, frame.origin.y + least.row * frame.resolution}};
  part.cells.reserve(part.frame.size());
  for (int row = least.row; row <= most.row; ++row)
    for (int column = least.column; column <= most.column; ++column) part.cells.push_back(map.at({column, row}));
  return part;
}

}  // namespace

SetupDesk::SetupDesk(const ModuleContext& context, telepresence::Site& site)
    : bus_{context.bus},
      site_{site},
      moved_{bus_.publisher(topics::kMuseumMoved)},
      orders_{bus_.publisher(topics::kExplorationOrder)} {
  if (!context.is_setup) return;
  telepresence::SetupOffice office{
      context.museum.folder,
      {context.museum.folder, context.state, context.checked_robot},
      [this](ExplorationOrder order) {
        bus_.post([this, order] { orders_.publish({{to_message(bus_.now()), ""}, to_text(order)}); });
      },
      [this] {
        bus_.post([this] {
          bus_.after(kReplyGoesOut, [this] { moved_.publish({{to_message(bus_.now()), ""}, false}); });
        });
      }};
  office_ = std::make_shared<const telepresence::SetupOffice>(std::move(office));
}

void SetupDesk::begin(telepresence::WebServer& server, int slot) {
  server.restrict_to(telepresence::Stream::operators, slot);
  site_.set_changing(kPicture, "image/png", std::make_shared<const std::string>(), "");
  bus_.subscribe<docent_msgs::Exploration>(topics::kExploration, [this](const auto& m) { exploration_ = m; });
  bus_.subscribe<nav_msgs::OccupancyGrid>(topics::kStaticMap, [this](const auto& map) { take(map); });
  bus_.every(kExplorationPeriod, [this, &server, slot] {
    std::string text = document();
    if (!text.empty() && std::exchange(shown_, text) != text) server.broadcast(slot, std::move(text));
  });
}

void SetupDesk::take(const nav_msgs::OccupancyGrid& map) {
  if (!exploration_) return;  // the museum's own map is fetched as that
  const auto grid = grid_of(map);
  if (!grid) return;
  const OccupancyGrid known = cropped(*grid);
  auto picture = telepresence::encode_map_png(known);
  if (!picture) return;
  frame_ = known.frame;
  ++number_;
  site_.set_changing(kPicture, "image/png", std::make_shared<const std::string>(std::move(*picture)),
                     std::to_string(number_));
}

std::string SetupDesk::document() const {
  if (!exploration_) return {};
  telepresence::documents::ExplorationMessage document;
  document.state = exploration_->state;
  document.order = exploration_->order;
  document.known_m2 = static_cast<double>(exploration_->known_m2);
  document.way_m = static_cast<double>(exploration_->way_m);
  document.frontier = exploration_->frontier;
  document.warning = exploration_->warning;
  for (std::size_t i = 0; i < exploration_->unreached_x.size() && i < exploration_->unreached_y.size(); ++i)
    document.unreached.push_back({exploration_->unreached_x[i], exploration_->unreached_y[i]});
  if (number_ > 0) {
    document.map = {std::string{kPicture} + "?" + std::to_string(number_),
                    frame_.columns,
                    frame_.rows,
                    frame_.resolution,
                    {frame_.origin.x, frame_.origin.y}};
  }
  return telepresence::json_text(document);
}

}  // namespace docent::modules
