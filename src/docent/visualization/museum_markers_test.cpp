#include "docent/visualization/museum_markers.h"

#include <gtest/gtest.h>

namespace docent::visualization {
namespace {

TEST(MuseumMarkers, BorderAndHazardsAreClosedLinesOfTheMap) {
  museum::Museum museum;
  museum.area = {{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}};
  museum.hazards.push_back({"plate", museum::HazardKind::plate, {{1.0, 1.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 2.0}}});
  museum.hazards.push_back({"glass", museum::HazardKind::glass, {{3.0, 1.0}, {3.5, 1.0}, {3.5, 1.1}}});
  const auto markers = museum_markers(museum).markers;
  ASSERT_EQ(markers.size(), 3U);
  EXPECT_EQ(markers[0].ns, "area");
  EXPECT_EQ(markers[1].ns, "hazards");
  EXPECT_NE(markers[1].id, markers[2].id);
  EXPECT_EQ(markers[0].points.size(), 4U);
  EXPECT_EQ(markers[1].points.size(), 5U);
  for (const auto& marker : markers) {
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_EQ(marker.type, 4) << "a line";
    EXPECT_GT(marker.scale.x, 0.0);
    EXPECT_EQ(marker.lifetime.sec, 0) << "for ever";
    EXPECT_EQ(marker.points.front().x, marker.points.back().x);
    EXPECT_EQ(marker.points.front().y, marker.points.back().y);
  }
}

}  // namespace
}  // namespace docent::visualization
