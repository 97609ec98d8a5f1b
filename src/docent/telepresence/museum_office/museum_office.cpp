#include "docent/telepresence/museum_office/museum_office.h"

#include <algorithm>

#include "docent/telepresence/museum_document.h"

namespace docent::telepresence {
namespace {

Pose2 pose_of(const documents::Pose& pose) { return {pose[0], pose[1], Angle::radians(pose[2])}; }

Polygon polygon_of(const std::vector<documents::Point>& corners) {
  Polygon polygon;
  for (const documents::Point& corner : corners) polygon.push_back({corner[0], corner[1]});
  return polygon;
}

museum::Exhibit exhibit_of(const documents::Exhibit& document) {
  museum::Exhibit exhibit;
  exhibit.id = document.id;
  exhibit.title = document.title;
  exhibit.pose = pose_of(document.pose);
  exhibit.look_at = {document.look_at[0], document.look_at[1]};
  for (const documents::Pose& viewpoint : document.viewpoints) exhibit.viewpoints.push_back(pose_of(viewpoint));
  exhibit.short_text = document.short_text;
  exhibit.long_text = document.long_text;
  exhibit.topics = document.topics;
  exhibit.web_only = document.web_only;
  exhibit.picture = document.picture;
  for (const documents::Link& link : document.links) exhibit.links.push_back({link.title, link.url});
  return exhibit;
}

/// A time that is none becomes one that no museum takes, so that it is named.
museum::Tour tour_of(const documents::Tour& document) {
  constexpr int kNever = 1440;
  museum::Tour tour{document.id, document.title, document.exhibits, document.minutes, {}};
  for (const std::string& time : document.daily) tour.daily.push_back(museum::parse_clock(time).value_or(kNever));
  std::sort(tour.daily.begin(), tour.daily.end());
  return tour;
}

/// @pre mode is one of kModes
std::vector<std::string>& hours_of(documents::OpeningHours& hours, const std::string& mode) {
  return mode == "open" ? hours.open : mode == "web" ? hours.web : hours.closed;
}

}  // namespace

documents::MuseumDraft document_of(const museum::MuseumDraft& draft) {
  documents::MuseumDraft document;
  document.area = document_of(draft.area);
  for (const museum::Hazard& hazard : draft.hazards) document.hazards.push_back(document_of(hazard));
  document.home = document_of(draft.home);
  if (draft.charger) document.charger = document_of(*draft.charger);
  for (const museum::Exhibit& exhibit : draft.exhibits) {
    document.exhibits.push_back(document_of(exhibit));
    document.exhibits.back().picture = exhibit.picture.generic_string();
  }
  for (const museum::Tour& tour : draft.tours) document.tours.push_back(document_of(tour));
  for (const museum::Room& room : draft.rooms) document.rooms.push_back({room.id, room.name, {room.at.x, room.at.y}});
  for (const auto& [mode, hours] : draft.hours) hours_of(document.hours, mode) = hours;
  return document;
}

museum::MuseumDraft draft_of(const documents::MuseumDraft& document) {
  museum::MuseumDraft draft;
  draft.area = polygon_of(document.area);
  for (const documents::Hazard& hazard : document.hazards)
    draft.hazards.push_back({hazard.id, hazard.kind, polygon_of(hazard.polygon)});
  draft.home = pose_of(document.home);
  if (document.charger) draft.charger = pose_of(*document.charger);
  for (const documents::Exhibit& exhibit : document.exhibits) draft.exhibits.push_back(exhibit_of(exhibit));
  for (const documents::Tour& tour : document.tours) draft.tours.push_back(tour_of(tour));
  for (const documents::RoomName& room : document.rooms)
    draft.rooms.push_back({room.id, room.name, {room.at[0], room.at[1]}});
  draft.hours = {{"open", document.hours.open}, {"web", document.hours.web}, {"closed", document.hours.closed}};
  return draft;
}

}  // namespace docent::telepresence
