#include "docent/planning/survey/surveyor.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "docent/base/files.h"
#include "docent/planning/survey/testing.h"

namespace docent::planning::surveyor_test {
namespace {

using Step = planning::Surveyor::Step;

/// A robot in a shut room of 6 x 4 m, which stands where the test puts it; odometry begins at home.
class Surveyor : public ::testing::Test {
 protected:
  Surveyor() {
    std::filesystem::create_directories(state);
    begin();
  }
  ~Surveyor() override { std::filesystem::remove_all(state); }

  void begin() {
    constexpr motion_models::BaseReach kAnywhere{100.0, 100.0};
    surveyor = std::make_unique<planning::Surveyor>(params, site, SurveyBody{testing::two_lasers(), 0.265, kAnywhere},
                                                    SurveyStore{state}, now);
  }
  /// A tenth of a second at `pose` in the room. @returns whether the moment went into the map
  bool sense(const Pose2& pose) {
    now = now + seconds(0.1);
    surveyor->move(now, {inverse(home) * pose, {}});
    for (const std::size_t laser : {1U, 0U}) {
      const auto ranges = testing::ranges_in_room(pose * testing::two_lasers()[laser], length);
      surveyor->keep(laser, now, testing::reading_of(ranges));
    }
    return surveyor->add_moment();
  }
  /// Seconds of it, with a plan each. @returns what the last one was
  Step stand(const Pose2& pose, int seconds_of_it) {
    Step step = Step::none;
    for (int second = 0; second < seconds_of_it && !surveyor->is_done(); ++second) {
      // No wheels repeat themselves to the last digit from one reading to the next while they are said to drive.
      for (int i = 0; i < 10; ++i) sense(pose * Pose2{0.0005 * (i % 2), 0.0, {}});
      step = surveyor->plan(now);
    }
    return step;
  }
  [[nodiscard]] SurveyPhase phase() const { return surveyor->report().phase; }

  std::filesystem::path state =
      std::filesystem::path{::testing::TempDir()} / ("docent_surveyor_" + std::to_string(getpid()));
  const Pose2 home{1.5, 2.0, {}};
  SurveyorParams params;
  SurveySite site{home, {}, {}};
  double length = 6.0;  // [m] of the room
  Time now = time_from_seconds(1000.0);
  std::unique_ptr<planning::Surveyor> surveyor;
};

TEST_F(Surveyor, WithoutOdometryAndLasersItHasNotBegun) {
  EXPECT_EQ(phase(), SurveyPhase::starting);
  EXPECT_FALSE(surveyor->has_odometry());
  EXPECT_EQ(surveyor->plan(now), Step::none);
  EXPECT_FALSE(surveyor->place());
  EXPECT_TRUE(surveyor->ahead().via.empty());
  surveyor->move(now, {});
  EXPECT_TRUE(surveyor->has_odometry());
  EXPECT_FALSE(surveyor->has_begun());
  EXPECT_EQ(surveyor->plan(now), Step::none);
  EXPECT_TRUE(surveyor->map().cells.empty());
}

TEST_F(Surveyor, ItKnowsWhereItBeginsAndHowWell) {
  EXPECT_TRUE(sense(home));
  EXPECT_FALSE(sense(home)) << "nothing new";
  EXPECT_EQ(phase(), SurveyPhase::exploring);
  const auto place = surveyor->place();
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->pose.map_from_base.x, 1.5, 1e-6);
  EXPECT_GE(place->pose.sigma, params.least_sigma);
  EXPECT_LE(place->pose.sigma, params.most_sigma);
  EXPECT_NEAR(place->odom_from_base.x, 0.0, 1e-9);
  EXPECT_TRUE(sense(home * Pose2{0.25, 0.0, {}}));
  EXPECT_NEAR(surveyor->place()->pose.map_from_base.x, 1.75, 0.03);
  EXPECT_NEAR(surveyor->report().way_m, 0.25, 1e-6);
}

TEST_F(Surveyor, WhenNothingIsLeftItGoesHomeAndMakesTheMap) {
  for (int i = 0; i < 30; ++i) sense(home * Pose2{0.08 * i, 0.0, {}});
  const Pose2 far = home * Pose2{0.08 * 29, 0.0, {}};
  EXPECT_EQ(stand(far, 1), Step::planned);
  for (int i = 0; i < 400 && phase() == SurveyPhase::exploring; ++i) stand(far, 1);
  EXPECT_EQ(phase(), SurveyPhase::returning);
  const auto ahead = surveyor->ahead();
  ASSERT_FALSE(ahead.via.empty());
  EXPECT_NEAR(ahead.via.back().x, 0.0, 0.2) << "home, as odometry has it";
  EXPECT_NEAR(surveyor->way().back().x, 1.5, 0.2) << "as the map has it";
  stand(home * Pose2{0.05, 0.01, {}}, 5);  // odometry of exactly zero would be one that began anew
  EXPECT_TRUE(surveyor->is_done());
  EXPECT_EQ(phase(), SurveyPhase::mapping);
  EXPECT_TRUE(surveyor->ahead().via.empty()) << "it stands";
  EXPECT_FALSE(sense(home * Pose2{0.5, 0.0, {}})) << "no more is seen";
  EXPECT_FALSE(surveyor->sight());
  const auto map = surveyor->finish(now);
  ASSERT_TRUE(map) << surveyor->fault();
  EXPECT_NEAR(free_area(*map), 24.0, 2.0);
  const auto report = surveyor->report();
  EXPECT_EQ(report.phase, SurveyPhase::done);
  EXPECT_EQ(report.known_m2, free_area(*map));
  EXPECT_TRUE(report.unreached.empty());
  EXPECT_EQ(report.map, (state / "explored" / "map.yaml").string());
  EXPECT_TRUE(std::filesystem::exists(state / "localize.yaml")) << "localize goes on from there";
}

TEST_F(Surveyor, WaitsForAnOrderWhereItIsTold) {
  params.waits_for_order = true;
  begin();
  EXPECT_EQ(stand(home, 12), Step::looked);
  EXPECT_EQ(surveyor->report().order, ExplorationOrder::wait);
  EXPECT_GT(surveyor->report().known_m2, 10.0) << "but it looks";
  EXPECT_TRUE(surveyor->ahead().via.empty());
  EXPECT_TRUE(surveyor->obey(ExplorationOrder::by_hand));
  EXPECT_EQ(stand(home, 400), Step::looked) << "it does not end by itself";
  EXPECT_EQ(phase(), SurveyPhase::exploring);
  EXPECT_TRUE(surveyor->obey(ExplorationOrder::by_itself));
  EXPECT_EQ(stand(home, 1), Step::planned);
}

TEST_F(Surveyor, FinishesWhenItIsToldAndObeysNothingAfterwards) {
  stand(home, 2);
  EXPECT_TRUE(surveyor->obey(ExplorationOrder::finish));
  EXPECT_TRUE(surveyor->is_done());
  EXPECT_FALSE(surveyor->obey(ExplorationOrder::by_itself));
  EXPECT_EQ(surveyor->report().order, ExplorationOrder::finish);
  EXPECT_EQ(surveyor->plan(now), Step::none);
  EXPECT_TRUE(surveyor->finish(now));
}

TEST_F(Surveyor, ToldToFinishBeforeItHasSeenAnythingItLooksFirst) {
  EXPECT_TRUE(surveyor->obey(ExplorationOrder::finish));
  EXPECT_FALSE(surveyor->is_done());
  sense(home);
  EXPECT_EQ(surveyor->plan(now), Step::ended);
  EXPECT_TRUE(surveyor->is_done());
}

TEST_F(Surveyor, AMapThatCannotBeSavedIsAFault) {
  stand(home, 2);
  ASSERT_TRUE(write_file_atomically(state / "explored", "a file stands in the way"));
  surveyor->obey(ExplorationOrder::finish);
  EXPECT_FALSE(surveyor->finish(now));
  EXPECT_NE(surveyor->fault().find("explored"), std::string::npos);
  EXPECT_EQ(phase(), SurveyPhase::mapping);
}

TEST_F(Surveyor, KeepsItsFrameForAMinute) {
  for (int i = 0; i < 20; ++i) sense(home * Pose2{0.05 * i, 0.0, {}});
  surveyor->plan(now);
  begin();
  sense(home * Pose2{0.05 * 19, 0.0, {}});
  EXPECT_NEAR(surveyor->place()->pose.map_from_base.x, 1.5 + 0.05 * 19, 0.05) << "marks that people have made hold";
  now = now + seconds(90.0);
  begin();
  sense(home * Pose2{0.05 * 19, 0.0, {}});
  EXPECT_NEAR(surveyor->place()->pose.map_from_base.x, 1.5, 1e-6) << "put away: nobody knows where it stands";
}

TEST_F(Surveyor, WhoStandsOnFloorThatWasFreeIsOfNoBuilding) {
  EXPECT_FALSE(surveyor->sight()) << "there is nothing to compare with";
  stand(home, 10);
  now = now + seconds(0.1);
  surveyor->move(now, {});
  auto ranges = testing::ranges_in_room(home);
  ranges[90] = 1.0F;
  surveyor->keep(0, now, testing::reading_of(ranges));
  const auto sight = surveyor->sight();
  ASSERT_TRUE(sight);
  ASSERT_EQ(sight->origins.size(), sight->look.sweep.beams.size());
  EXPECT_EQ(sight->origins[90], sensor_models::BeamOrigin::not_map);
  EXPECT_EQ(sight->origins[60], sensor_models::BeamOrigin::map);
  EXPECT_NEAR(sight->map_from_base.x, 1.5, 0.02);
}

TEST_F(Surveyor, WhoWalksIsLeftOutOfTheMap) {
  surveyor->note_people(std::vector<TrackedPerson>{{1, {3.0, 0.0}}});
  surveyor->note_people(std::vector<TrackedPerson>{{1, {4.0, 0.0}}});
  const Point2 behind_them{6.02, 2.0};  // the wall by which they stand
  for (int i = 0; i < 4; ++i) {
    sense(home * Pose2{0.25 * i, 0.0, {}});
    surveyor->note_people(std::vector<TrackedPerson>{{1, {4.5, 0.0}}});
  }
  const auto map = surveyor->map();
  EXPECT_FALSE(map.is_occupied(map.frame.cell_at(behind_them)));
  EXPECT_TRUE(map.is_occupied(map.frame.cell_at({0.02, 2.0}))) << "the wall behind the robot";
}

TEST_F(Surveyor, GoesRoundWhereItIsHeldUpButNotWhileSomebodyHoldsIt) {
  length = 30.0;  // nobody sees its end from here
  const auto side_of_way = [&](bool is_stopped, bool is_steered) {
    std::filesystem::remove(state / "explore.yaml");
    begin();
    surveyor->note_stop(is_stopped);
    for (int second = 0; second < 12; ++second) {
      if (is_steered) surveyor->note_steering(now);
      stand(home, 1);
    }
    EXPECT_FALSE(surveyor->way().empty());
    double most = 0.0;
    for (const Point2 point : surveyor->way()) most = std::max(most, std::abs(point.y - home.y));
    return most;
  };
  const double straight = side_of_way(true, false);
  EXPECT_NEAR(side_of_way(false, true), straight, 0.1);
  EXPECT_GT(side_of_way(false, false), straight + 0.2);
}

TEST_F(Surveyor, LaysItsSiteOntoTheWallsWhenItWasSetDownAskew) {
  length = 5.0;
  site.area = {{0.3, 0.3}, {4.7, 0.3}, {4.7, 3.7}, {0.3, 3.7}};
  site.hazards = {{{4.0, 3.0}, {4.2, 3.0}, {4.2, 3.2}}};
  begin();
  EXPECT_GT(surveyor->report().mark_margin, -1e-9);
  // Truly it stands 8 degrees to the left of what it was told: odometry begins there.
  const Pose2 truth{1.5, 2.0, Angle::degrees(8.0)};
  for (int i = 0; i < 40; ++i) {
    const Pose2 moved{0.05 * i, 0.0, Angle::degrees(9.0 * i)};
    now = now + seconds(0.1);
    surveyor->move(now, {moved, {}});
    for (const std::size_t laser : {1U, 0U})
      surveyor->keep(
          laser, now,
          testing::reading_of(testing::ranges_in_room(truth * moved * testing::two_lasers()[laser], length)));
    surveyor->add_moment();
    surveyor->plan(now);
  }
  const Pose2 last = truth * Pose2{0.05 * 39, 0.0, Angle::degrees(9.0 * 39)};
  const auto place = surveyor->place();
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->pose.map_from_base.x, last.x, 0.1);
  EXPECT_NEAR(place->pose.map_from_base.y, last.y, 0.1);
  EXPECT_LT(std::abs((place->pose.map_from_base.theta - last.theta).degrees()), 1.5);
  EXPECT_LT(surveyor->report().mark_margin, 0.3);
  EXPECT_NE(surveyor->plea().find("degrees from where I was told"), std::string::npos) << surveyor->plea();
}

TEST_F(Surveyor, AMapThatEndsAwayFromHomeIsNotDone) {
  params.drive.enclosed = 3.0;
  params.drive.patience = 2.0;
  begin();
  for (int i = 0; i < 30; ++i) sense(home * Pose2{0.08 * i, 0.0, {}});
  const Pose2 far = home * Pose2{0.08 * 29, 0.0, {}};
  surveyor->note_hindrance(ExplorationDrive::Hindrance::unknown, "no beam of the front laser ends anywhere");
  for (int i = 0; i < 900 && !surveyor->is_done(); ++i) stand(far, 1);  // something holds it for ever
  ASSERT_TRUE(surveyor->is_done());
  ASSERT_TRUE(surveyor->finish(now));
  EXPECT_EQ(phase(), SurveyPhase::stranded);
  const std::string warning = surveyor->report().warning;
  EXPECT_NE(warning.find("from its home: it was held up on its ways there, while no beam of the front laser ends"),
            std::string::npos)
      << warning;
}

TEST_F(Surveyor, BeginsTheMapAnewWhenALaserIsFoundElsewhere) {
  for (int i = 0; i < 10; ++i) sense(home * Pose2{0.2 * i, 0.0, {}});
  surveyor->plan(now);
  surveyor->mount(0, testing::two_lasers()[0]);
  EXPECT_GT(surveyor->report().known_m2, 1.0) << "where it was";
  surveyor->mount(0, Pose2{0.0, 0.0, Angle::degrees(5.0)});
  EXPECT_TRUE(surveyor->map().cells.empty());
  EXPECT_NEAR(surveyor->place()->pose.map_from_base.x, 1.5 + 1.8, 0.01) << "from where odometry has it";
}

}  // namespace
}  // namespace docent::planning::surveyor_test
