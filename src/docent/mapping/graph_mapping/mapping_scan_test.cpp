#include "docent/mapping/graph_mapping/mapping_scan.h"

#include <gtest/gtest.h>

namespace docent::mapping::mapping_scan_test {
namespace {

TEST(ScanChoice, TakesTheFirstScanAndThoseAfterAWayOrATurn) {
  ScanChoice choice{{.way = 0.25, .turn = 10.0}};
  EXPECT_TRUE(choice.takes({7.0, 7.0, {}})) << "the first one";
  EXPECT_FALSE(choice.takes({7.0, 7.0, {}})) << "it stands";
  EXPECT_FALSE(choice.takes({7.2, 7.0, {}}));
  EXPECT_TRUE(choice.takes({7.3, 7.0, {}})) << "since the last one taken, not the last one seen";
  EXPECT_FALSE(choice.takes({7.3, 7.0, Angle::degrees(9.0)}));
  EXPECT_TRUE(choice.takes({7.3, 7.0, Angle::degrees(-11.0)}));
  EXPECT_TRUE(choice.takes({7.0, 7.0, Angle::degrees(-11.0)})) << "backwards, too";
}

TEST(ScanChoice, WithoutAWayTakesAll) {
  ScanChoice choice{{.way = 0.0, .turn = 0.0}};
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(choice.takes({}));
}

}  // namespace
}  // namespace docent::mapping::mapping_scan_test
