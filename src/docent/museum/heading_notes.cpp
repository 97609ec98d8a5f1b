#include "docent/museum/heading_notes.h"

#include <cstdio>

#include "docent/geometry/unit_slip.h"

namespace docent::museum {

std::vector<std::string> heading_notes(const Museum& museum) {
  std::vector<std::string> notes;
  const auto look_at = [&](const std::string& place, const Pose2& pose) {
    if (!looks_like_radians(pose.theta.degrees())) return;
    char text[160];
    std::snprintf(text, sizeof text, ": a heading of %g is read as degrees; if radians are meant, write %.0f",
                  pose.theta.degrees(), Angle::radians(pose.theta.degrees()).degrees());
    notes.push_back("museum.yaml, " + place + text);
  };
  look_at("home", museum.home);
  if (museum.charger) look_at("charger", *museum.charger);
  for (const Exhibit& exhibit : museum.exhibits) {
    look_at("exhibit '" + exhibit.id + "'", exhibit.pose);
    for (const Pose2& viewpoint : exhibit.viewpoints) look_at("a viewpoint of '" + exhibit.id + "'", viewpoint);
  }
  return notes;
}

}  // namespace docent::museum
