#pragma once

#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/museum/museum.h"
#include "docent/telepresence/client_message.h"
#include "docent/telepresence/documents.h"
#include "docent/vocabulary/reason.h"

namespace docent::telepresence {

[[nodiscard]] documents::Pose document_of(const Pose2& pose);
[[nodiscard]] std::vector<documents::Point> document_of(const Polygon& polygon);
[[nodiscard]] documents::Hazard document_of(const museum::Hazard& hazard);
[[nodiscard]] documents::Exhibit document_of(const museum::Exhibit& exhibit);
[[nodiscard]] documents::Tour document_of(const museum::Tour& tour);

/// All that a page must know of the museum and its map, as JSON text. `robot_radius` in metres.
[[nodiscard]] std::string encode_museum(const museum::Museum& museum, double robot_radius, documents::Rooms rooms = {});

/// Where the exhibit's picture can be fetched; empty: it has none.
[[nodiscard]] std::string picture_address(const museum::Exhibit& exhibit);

/// Why the museum cannot show what is asked for; none: it can.
[[nodiscard]] Reason why_not_in(const museum::Museum& museum, const RequestMessage& message);

/// The map as a grey PNG, a pixel a cell, the highest row on top: 255 free, 128 unknown, 0 occupied.
[[nodiscard]] Result<std::string> encode_map_png(const OccupancyGrid& map);

}  // namespace docent::telepresence
