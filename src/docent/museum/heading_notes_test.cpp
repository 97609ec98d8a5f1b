#include "docent/museum/heading_notes.h"

#include <gtest/gtest.h>

namespace docent::museum {
namespace {

TEST(HeadingNotes, EachPlaceWhoseHeadingLooksLikeRadiansIsNamed) {
  Museum museum;
  museum.home.theta = Angle::degrees(90.0);
  museum.charger = Pose2{1.0, 1.0, Angle::degrees(-150.0)};
  museum.exhibits.resize(1);
  museum.exhibits[0].id = "clock";
  museum.exhibits[0].viewpoints.push_back({2.0, 1.0, Angle::degrees(3.0)});
  EXPECT_TRUE(heading_notes(museum).empty()) << heading_notes(museum).front();
  museum.charger->theta = Angle::degrees(-1.5708);
  museum.exhibits[0].pose.theta = Angle::degrees(3.14159);
  museum.exhibits[0].viewpoints[0].theta = Angle::degrees(2.356);
  const auto notes = heading_notes(museum);
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_EQ(notes[0], "museum.yaml, charger: a heading of -1.5708 is read as degrees; if radians are meant, write -90");
  EXPECT_NE(notes[1].find("'clock': a heading of 3.14159 "), std::string::npos) << notes[1];
  EXPECT_NE(notes[2].find("a viewpoint of 'clock'"), std::string::npos) << notes[2];
}

}  // namespace
}  // namespace docent::museum
