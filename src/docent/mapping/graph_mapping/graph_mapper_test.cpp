#include "docent/mapping/graph_mapping/graph_mapper.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "docent/mapping/graph_mapping/graph_mapping.h"
#include "docent/mapping/graph_mapping/testing.h"

namespace docent::mapping {
namespace {

using testing::Drive;

std::vector<Pose2> by_odometry(const Drive& drive) {
  std::vector<Pose2> poses;
  for (const MappingScan& scan : drive.scans) poses.push_back(scan.odom_from_base);
  return poses;
}

TEST(GraphMapping, ClosesARingThatOdometryLeavesOpen) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const Drive drive = testing::drive_round(1.4, 0.02, 0.05, seed);
    EXPECT_GT(testing::relation_error(drive.truth, by_odometry(drive), 150), 8.0) << "odometry is that bad";
    const GraphMap map = map_by_graph(drive.scans, {});
    EXPECT_LT(testing::relation_error(drive.truth, map.map_from_base, 150), 0.10) << "seed " << seed;
    EXPECT_GE(map.loops, 2U);
    EXPECT_TRUE(map.judgement.is_trusted) << map.judgement.reason;
    EXPECT_LT(map.revisit_error, 0.05);
  }
}

TEST(GraphMapping, SaysSoWhereNothingWasSeenTwice) {
  const Drive drive = testing::drive_round(0.7, 0.02, 0.05, 3);
  const GraphMap map = map_by_graph(drive.scans, {});
  EXPECT_EQ(map.loops, 0U);
  EXPECT_EQ(map.judgement.pairs, 0U);
  const Drive round = testing::drive_round(1.4, 0.02, 0.05, 3);
  EXPECT_GT(map.judgement.expected_error, map_by_graph(round.scans, {}).judgement.expected_error);
}

TEST(GraphMapping, AMapThatContradictsItselfIsNotTrusted) {
  const Drive drive = testing::drive_round(1.4, 0.02, 0.05, 1);
  GraphMapperParams crippled;
  crippled.loops.least_score = 1.1;  // no loop is ever closed,
  crippled.chain.least_score = 1.1;  // and only odometry is believed
  crippled.fine_rounds = 0;
  const GraphMap map = map_by_graph(drive.scans, crippled);
  EXPECT_EQ(map.loops, 0U);
  EXPECT_EQ(map.unmatched, drive.scans.size() - 1);
  EXPECT_GT(testing::relation_error(drive.truth, map.map_from_base, 150), 1.0);
  EXPECT_FALSE(map.judgement.is_trusted);
}

TEST(GraphMapping, MarksAreDoubtedTheFartherItDrivesUntilALoopCloses) {
  const Drive drive = testing::drive_round(1.4, 0.0, 0.02, 2);
  GraphMapping mapping{{}};
  std::vector<double> doubt;
  for (const MappingScan& scan : drive.scans) {
    mapping.add(scan);
    doubt.push_back(mapping.doubt_of_marks());
  }
  EXPECT_GT(doubt[80], doubt[20]);
  EXPECT_LT(doubt.back(), 0.5 * doubt[120]) << "having come round";
}

TEST(GraphMapping, SomebodyWhoWalksAlongIsNotTheWorld) {
  Drive drive = testing::drive_round(0.7, 0.001, 0.01, 6);  // no loop puts it right afterwards
  testing::walk_along(drive, 10, 14);                       // also before anything is known of odometry
  testing::walk_along(drive, 60, 80);
  EXPECT_LT(testing::relation_error(drive.truth, map_by_graph(drive.scans, {}).map_from_base, 30), 0.15);
  GraphMapperParams crippled;
  crippled.contradiction = 1e3;
  EXPECT_GT(testing::relation_error(drive.truth, map_by_graph(drive.scans, crippled).map_from_base, 30), 1.0);
}

TEST(GraphMapping, OdometryMayJumpAThousandKilometres) {
  Drive drive = testing::drive_round(0.3, 0.0, 0.02, 5);
  const std::size_t jump = drive.scans.size() / 2;
  for (std::size_t i = jump; i < drive.scans.size(); ++i) drive.scans[i].odom_from_base.x += 1e6;
  const GraphMap map = map_by_graph(drive.scans, {});
  ASSERT_EQ(map.map_from_base.size(), drive.scans.size());
  for (const auto& [first, last] : {std::pair{std::size_t{0}, jump - 1}, {jump, drive.scans.size() - 1}}) {
    const Pose2 way = inverse(map.map_from_base[first]) * map.map_from_base[last];
    const Pose2 truth = inverse(drive.truth[first]) * drive.truth[last];
    EXPECT_LT(distance(way.position(), truth.position()), 0.5) << "before and behind it maps as ever";
  }
}

TEST(GraphMapping, TheSameScansGiveTheSameMap) {
  const Drive drive = testing::drive_round(0.4, 0.02, 0.05, 4);
  const GraphMap first = map_by_graph(drive.scans, {});
  const GraphMap second = map_by_graph(drive.scans, {});
  for (std::size_t i = 0; i < first.map_from_base.size(); ++i) {
    ASSERT_EQ(first.map_from_base[i].x, second.map_from_base[i].x);
    ASSERT_EQ(first.map_from_base[i].theta.radians(), second.map_from_base[i].theta.radians());
  }
}

TEST(GraphMapping, TellsHowFarItIs) {
  const Drive drive = testing::drive_round(0.4, 0.02, 0.05, 5);
  std::size_t last = 0;
  std::size_t told = 0;
  const GraphMap map = map_by_graph(drive.scans, {}, [&](const MappingProgress& progress) {
    ++told;
    last = progress.done;
    EXPECT_LE(progress.done, progress.of);
  });
  EXPECT_GT(told, 3U);
  EXPECT_EQ(last, drive.scans.size());
  EXPECT_TRUE(map_by_graph({}, {}).map_from_base.empty());
}

/// Spoils one number after the other, in all parts, and reads what the params say of it.
class Spoiler {
 public:
  explicit Spoiler(GraphMapperParams& params) : params_{params} { params.visit(*this); }
  template <class T>
  void operator()(const std::string& name, T& value) {
    if constexpr (requires { value.visit(*this); }) {
      const std::string outer = std::exchange(part_, part_ + name + ".");
      value.visit(*this);
      part_ = outer;
    } else {
      const T sound = value;
      expect_refusal(name, value = T{-1});
      if constexpr (std::is_floating_point_v<T>) expect_refusal(name, value = std::numeric_limits<T>::quiet_NaN());
      value = sound;
    }
  }
  [[nodiscard]] int refused() const { return refused_; }

 private:
  void expect_refusal(const std::string& name, double value) {
    const auto valid = params_.validate();
    ASSERT_FALSE(valid) << part_ << name << ": " << value;
    EXPECT_EQ(valid.error().message.rfind(part_ + name + " must be ", 0), 0U) << valid.error().message;
    ++refused_;
  }
  GraphMapperParams& params_;
  std::string part_;
  int refused_ = 0;
};

TEST(GraphMapperParams, RefuseEachNumberThatIsOutOfBounds) {
  GraphMapperParams params;
  EXPECT_TRUE(params.validate());
  EXPECT_GT(Spoiler{params}.refused(), 90);
  EXPECT_TRUE(params.validate());
}

TEST(GraphMapperParams, RefuseBoundsThatCrossEachOther) {
  const auto fault_of = [](const GraphMapperParams& params) { return params.validate().error().message; };
  GraphMapperParams params;
  params.loops.least_window = params.loops.widest_window + 1.0;
  EXPECT_EQ(fault_of(params), "loops.least_window must be >= 0 m and <= widest_window");
  params = {};
  params.loops.least_turn = 3.2;
  EXPECT_EQ(fault_of(params), "loops.least_turn must be 0..pi rad");
  params = {};
  params.lines.first_gate = 0.5;
  EXPECT_EQ(fault_of(params), "lines.first_gate must be in (0, 0.4] m");
  params = {};
  params.least_odometry_scale = 1.5;
  EXPECT_EQ(fault_of(params), "least_odometry_scale must be in (0, 1]");
  params = {};
  params.chain.least_score = 1.1;
  EXPECT_EQ(fault_of(params), "chain.least_score must be 0..1");
}

TEST(Submap, KnowsTheFloorThatWasSeenThrough) {
  const Drive drive = testing::drive_round(0.1, 0.0, 0.0, 6);
  const Submap submap{drive.scans, drive.truth, 0, 6, {}, {0.10, 0.10, 4}};
  const Pose2 map_from_middle = drive.truth[submap.middle()];
  EXPECT_TRUE(submap.is_free(inverse(map_from_middle) * Point2{5.0, 1.5}));
  EXPECT_FALSE(submap.is_free(inverse(map_from_middle) * Point2{5.0, 3.1})) << "inside the block";
  EXPECT_LT(share_in_conflict(submap, submap, {}), 0.01);
  EXPECT_GT(share_in_conflict(submap, submap, {0.0, 1.2, {}}), 0.15) << "a wall in the middle of the corridor";
}

/// Somebody walks towards the robot: each scan sees him elsewhere, and the next ones the floor where he was.
TEST(Submap, LeavesOutWhoWalksBy) {
  testing::Drive drive = testing::drive_round(0.1, 0.0, 0.0, 6);
  std::vector<Point2> walker;
  for (std::size_t i = 0; i <= 6; ++i) {
    walker.push_back(Point2{9.0 - 0.5 * static_cast<double>(i), 1.2});
    const Point2 seen = inverse(drive.truth[i]) * walker.back();
    std::erase_if(drive.scans[i].points, [&](const SurfacePoint& point) {  // he hides what is behind him
      return std::abs((direction({}, point.at) - direction({}, seen)).degrees()) < 2.5;
    });
    for (double side = -0.1; side <= 0.1; side += 0.05) drive.scans[i].points.push_back({{seen.x, seen.y + side}, {}});
  }
  const Submap submap{drive.scans, drive.truth, 0, 6, {}, {0.10, 0.10, 4}};
  const Pose2 map_from_middle = drive.truth[submap.middle()];
  std::size_t of_walker = 0;
  for (const SurfacePoint& point : submap.points()) {
    for (const Point2 at : walker) of_walker += distance(map_from_middle * point.at, at) < 0.2 ? 1U : 0U;
  }
  EXPECT_LT(of_walker, 20U) << "of 35 points; those beside his last places nobody saw through";
  SubmapParams crippled;
  crippled.still = 0.0;
  const Submap all{drive.scans, drive.truth, 0, 6, crippled, {0.10, 0.10, 4}};
  EXPECT_GE(all.points().size(), submap.points().size() + 20);
  EXPECT_LT(all.points().size(), submap.points().size() + 80) << "walls stay";
}

}  // namespace
}  // namespace docent::mapping
