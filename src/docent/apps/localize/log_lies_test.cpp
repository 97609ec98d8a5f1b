#include "docent/apps/localize/log_lies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "docent/collision_avoidance/expected_sweeps/room_for_test.h"

namespace docent::apps::localize_command::log_lies_test {
namespace {

/// A drive of 8 s through a room; from 4 s on the laser says what `lie` makes of it.
std::vector<std::string> notes_of(const std::function<void(recording::LaserLog&, std::vector<float>&)>& lie) {
  collision_avoidance::RoomForTest room;
  room.box(-4, -3, 9, 4);
  room.discs = {{{2.0, 2.0}, 0.3}, {{3.5, -1.5}, 0.25}};
  recording::LaserLog log;
  log.max_range = 10.0;
  Pose2 at;
  for (int i = 0; i < 80; ++i) {
    at = at * Pose2{0.05, 0.0, Angle::radians(0.01)};
    const auto sweep = room.sweep(10.0 + 0.1 * i, at);
    recording::LoggedScan scan;
    scan.time = sweep.stamp;
    scan.first_bearing = Angle::radians(sweep.first_bearing);
    scan.bearing_step = sweep.bearing_step;
    scan.ranges = sweep.ranges;
    scan.odom_from_base = at;
    if (i >= 40) lie(log, scan.ranges);
    log.scans.push_back(scan);
  }
  return lies_in(log);
}

TEST(LogLies, AScannerInOrderIsNotNamed) {
  EXPECT_TRUE(notes_of([](recording::LaserLog&, std::vector<float>&) {}).empty());
}

TEST(LogLies, NamesEachWithWhenItBegan) {
  const auto offset = notes_of([](recording::LaserLog&, std::vector<float>& ranges) {
    for (float& range : ranges) range += 0.5F;
  });
  ASSERT_EQ(offset.size(), 1U);
  EXPECT_EQ(offset[0], "the distances of the front laser are 0.5 m too long: from 4.1 s on, in 39 of 80 scans");
  const auto sector = notes_of([](recording::LaserLog&, std::vector<float>& ranges) {
    std::fill(ranges.begin() + 60, ranges.begin() + 120, std::numeric_limits<float>::infinity());
  });
  ASSERT_EQ(sector.size(), 1U);
  EXPECT_NE(sector[0].find("the front laser sees nothing in a part of its field: from 4."), std::string::npos)
      << sector[0];
  const auto stale = notes_of(
      [](recording::LaserLog& log, std::vector<float>& ranges) { ranges = log.scans[log.scans.size() - 30].ranges; });
  ASSERT_EQ(stale.size(), 1U);
  EXPECT_NE(stale[0].find("the front laser repeats old sweeps: from 4."), std::string::npos) << stale[0];
}

}  // namespace
}  // namespace docent::apps::localize_command::log_lies_test
