#include "docent/visualization/people_markers.h"

#include <gtest/gtest.h>

namespace docent::visualization {
namespace {

TEST(PeopleMarkers, ACylinderEachAndAnArrowForWhoWalks) {
  docent_msgs::People people;
  people.header = {{7, 8}, "map"};
  people.people = {{4, 1.0F, 2.0F, 0.5F, -1.0F}, {4294967295U, 3.0F, 4.0F, 0.02F, 0.0F}};
  people.groups = {0, 3};
  const auto markers = people_markers(people).markers;
  ASSERT_EQ(markers.size(), 3U);
  for (const auto& marker : markers) {
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_EQ(marker.header.stamp.sec, 7);
    EXPECT_EQ(marker.action, 0);
    EXPECT_EQ(marker.lifetime.sec, 1) << "who is lost vanishes by itself";
    EXPECT_EQ(marker.lifetime.nanosec, 0U);
    EXPECT_GT(marker.color.a, 0.0F);
  }
  EXPECT_EQ(markers[0].ns, "people");
  EXPECT_EQ(markers[0].type, 3) << "a cylinder";
  EXPECT_EQ(markers[0].id, 4);
  EXPECT_EQ(markers[0].pose.position.x, 1.0);
  EXPECT_EQ(markers[0].pose.position.y, 2.0);
  EXPECT_EQ(2.0 * markers[0].pose.position.z, markers[0].scale.z) << "it stands on the floor";
  EXPECT_EQ(markers[1].ns, "velocities");
  EXPECT_EQ(markers[1].type, 0) << "an arrow";
  EXPECT_EQ(markers[1].id, 4);
  ASSERT_EQ(markers[1].points.size(), 2U);
  EXPECT_EQ(markers[1].points[0].x, 1.0);
  EXPECT_EQ(markers[1].points[1].x, 1.5);
  EXPECT_EQ(markers[1].points[1].y, 1.0);
  EXPECT_EQ(markers[1].pose.position.x, 0.0) << "its points are in the frame already";
  EXPECT_EQ(markers[2].ns, "people");
  EXPECT_GE(markers[2].id, 0);
  EXPECT_NE(markers[2].color.b, markers[0].color.b) << "of a group";
}

TEST(PeopleMarkers, NobodyIsAnEmptyArray) {
  EXPECT_TRUE(people_markers({}).markers.empty());
  docent_msgs::People people;
  people.people.resize(2);
  EXPECT_EQ(people_markers(people).markers.size(), 2U) << "without groups all are alone";
}

TEST(PeopleMarkers, LivesForPartsOfASecondToo) {
  docent_msgs::People people;
  people.people.resize(1);
  PeopleMarkerParams params;
  params.lifetime = 2.25;
  const auto markers = people_markers(people, params).markers;
  EXPECT_EQ(markers[0].lifetime.sec, 2);
  EXPECT_EQ(markers[0].lifetime.nanosec, 250000000U);
}

}  // namespace
}  // namespace docent::visualization
