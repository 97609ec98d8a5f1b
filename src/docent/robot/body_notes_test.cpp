#include "docent/robot/body_notes.h"

#include <gtest/gtest.h>

namespace docent::robot {
namespace {

TEST(BodyNotes, AHeadingThatLooksLikeRadiansIsNoted) {
  RobotBody body;
  EXPECT_TRUE(body_notes(body).empty());
  for (const double slip : {3.14159, -3.1416, 1.5708, -1.57, 0.785, 2.356, 6.2832, 1.0472}) {
    body.scanners[1].heading = slip;
    ASSERT_EQ(body_notes(body).size(), 1U) << slip;
    EXPECT_NE(body_notes(body)[0].find("rear"), std::string::npos);
  }
  for (const double right : {0.0, 3.0, -2.0, 180.0, -90.0, 0.5, 1.2, 2.5, 5.8, 10.3, 45.0}) {
    body.scanners[1].heading = right;
    EXPECT_TRUE(body_notes(body).empty()) << right;
  }
}

}  // namespace
}  // namespace docent::robot
