#include "docent/evaluation/reference/relations.h"

#include <gtest/gtest.h>

namespace docent::evaluation {
namespace {

TimedPose pose(double time, double x, double y, double degrees) {
  return {time_from_seconds(time), {x, y, Angle::degrees(degrees)}};
}

TEST(Relations, AreReadWithTheirYaw) {
  const auto relations = parse_relations("# t1 t2 x y z roll pitch yaw\n10 12.5 1 2 0 0 0 1.5\n\n", "file");
  ASSERT_TRUE(relations);
  ASSERT_EQ(relations->size(), 1U);
  EXPECT_EQ(to_seconds(relations->front().second), 12.5);
  EXPECT_EQ(relations->front().first_from_second.y, 2.0);
  EXPECT_NEAR(relations->front().first_from_second.theta.radians(), 1.5, 1e-12);
}

TEST(Relations, FaultsNameFileAndLine) {
  EXPECT_EQ(parse_relations("1 2 3 4 5 6 7 8\n1 2 3\n", "a").error().message,
            "a:2: expected t1 t2 x y z roll pitch yaw");
  EXPECT_EQ(parse_relations("1 2 3 4 5 6 7 8 9\n", "a").error().message, "a:1: more than t1 t2 x y z roll pitch yaw");
  EXPECT_EQ(parse_relations("# nothing\n", "a").error().message, "a: holds no relation");
}

TEST(Relations, AreScoredBetweenPosesAndWithoutAligningTheWhole) {
  const std::vector<TimedPose> truth{pose(0, 0, 0, 0), pose(1, 1, 0, 0), pose(2, 2, 0, 90)};
  const std::vector<Relation> relations{{truth[0].time, truth[1].time, {1.0, 0.0, {}}},
                                        {time_from_seconds(0.5), truth[1].time, {0.5, 0.0, {}}},
                                        {truth[1].time, time_from_seconds(9), {}}};
  EXPECT_EQ(score_relations(relations, truth).relations, 2U);
  EXPECT_NEAR(score_relations(relations, truth).metres, 0.0, 1e-12);
  std::vector<TimedPose> elsewhere;  // the same way, in another frame
  for (const TimedPose& p : truth) elsewhere.push_back({p.time, Pose2{5.0, 3.0, Angle::degrees(40)} * p.map_from_base});
  EXPECT_NEAR(score_relations(relations, elsewhere).metres, 0.0, 1e-9);
  std::vector<TimedPose> longer = truth;
  longer[1].map_from_base.x = 1.2;
  const RelationScore score = score_relations(relations, longer);
  EXPECT_NEAR(score.metres, 0.5 * (0.2 + 0.1), 1e-9);
  EXPECT_NEAR(score.metres_spread, 0.05, 1e-9);
  EXPECT_NEAR(score.metres_worst, 0.2, 1e-9);
}

TEST(Relations, OfAKnownWayLieSoFarApart) {
  std::vector<TimedPose> truth;
  for (int i = 0; i <= 10; ++i) truth.push_back(pose(i, i, 0, 0));
  const std::vector<double> apart{3.0, 20.0};
  const auto relations = relations_between(truth, apart);
  ASSERT_EQ(relations.size(), 8U);
  EXPECT_NEAR(relations.front().first_from_second.x, 3.0, 1e-12);
}

}  // namespace
}  // namespace docent::evaluation
